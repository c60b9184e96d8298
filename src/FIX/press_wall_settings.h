// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PRESS_WALL_SETTINGS_H
#define GRAINSCOPE_PRESS_WALL_SETTINGS_H

#include "number_source.h"
#include "pressure_control.h"
#include <string>

namespace grainscope {

class Arguments;

/** What the words of a fix press/wall command say; see doc/fix_press_wall.md. */
struct PressWallSettings {
  enum class Every { time, step };

  std::string mesh;
  int axis = -1;
  double toward = 0.0;  // along the axis, 1 or -1; 0: where the grains are
  NumberSource target;
  bool target_varies = false;
  double area = 0.0;  // 0: of the box, across the axis
  Every every = Every::step;
  double interval = 0.0;  // time or steps between two inputs
  PressureControl control;
  bool base = false;  // the plate has a velocity besides what the error gives
  bool limit_given = false, max_rate_given = false;

  /** Reads all words from arg[3] on; every mistake is an error. */
  PressWallSettings(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg);

 private:
  void read(Arguments &arguments, const std::string &keyword);
};

}

#endif

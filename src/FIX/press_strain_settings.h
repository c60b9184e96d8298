// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PRESS_STRAIN_SETTINGS_H
#define GRAINSCOPE_PRESS_STRAIN_SETTINGS_H

#include "pressure_control.h"
#include "sheared_box.h"
#include <string>

namespace grainscope {

/** A number, or an equal-style variable v_name. */
struct Quantity {
  double value = 0.0;
  std::string variable;
};

/** What the words of a fix press/strain command say; see doc/fix_press_strain.md. */
struct PressStrainSettings {
  enum class Every { strain, time, step };

  int axis = 1;
  const Tilt *shear = nullptr;  // null: no shear
  Quantity target, rate;
  Every every = Every::strain;
  double interval = 0.0;  // strain, time or steps between two inputs
  PressureControl control;
  bool max_rate_given = false;
  bool remove_momentum = true, kinetic = false;

  /** Reads all words from arg[3] on; every mistake is an error. */
  PressStrainSettings(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg);

  /** Values of variables now; errors where they are of no use. */
  void evaluate_rate(LAMMPS_NS::LAMMPS *lmp);
  void evaluate_target(LAMMPS_NS::LAMMPS *lmp);
};

/** An error that starts with the name of the fix. */
[[noreturn]] void press_strain_error(LAMMPS_NS::LAMMPS *lmp, const std::string &message);

}

#endif

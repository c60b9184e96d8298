// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PRESS_STRAIN_SETTINGS_H
#define GRAINSCOPE_PRESS_STRAIN_SETTINGS_H

#include "pressure_control.h"
#include "sheared_box.h"
#include <set>
#include <string>
#include <vector>

namespace grainscope {

class Arguments;

/** A number, or an equal-style variable v_name. */
struct Quantity {
  double value = 0.0;
  std::string variable;
};

/** How one mode of the box moves: not at all; at a true rate; so that its stress is held (pressure of an edge, shear
 *  stress of a tilt); or, an edge, with others so that the mean pressure is held. */
struct BoxMotion {
  enum class How { still, rate, target, mean };
  How how = How::still;
  Quantity value;      // rate or target
  double ratio = 1.0;  // of the common rate, with How::mean: 1 for the fastest edge
  bool given = false;  // by a word of its own
  std::string word;    // by which messages name its value

  bool moves() const { return how != How::still; }
  bool controlled() const { return how == How::target || how == How::mean; }
};

/** What the words of a fix press/strain command say; see doc/fix_press_strain.md. */
struct PressStrainSettings {
  enum class Every { strain, time, step };

  BoxMotion motions[number_of_box_modes];  // of the modes of box_modes
  bool has_mean = false;
  Quantity mean;  // its target
  Every every = Every::strain;
  double interval = 0.0;  // strain, time or steps between two inputs
  PressureControl control;
  bool max_rate_given = false;
  bool remove_momentum = true, kinetic = false;

  /** Reads all words from arg[3] on; every mistake is an error. */
  PressStrainSettings(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg);

  /** The edge that the first elements of the output are about: the first with a target, or the first that moves with
   *  the mean; -1 without either. */
  int main_edge() const;
  /** Modes whose stiffness the controller asks for: those with a target, and all edges with a mean. */
  std::vector<int> controlled_modes(int dimension) const;
  bool sheared() const;
  bool drives_an_edge() const;
  bool follows_variables() const;
  /** The rate of the strain that `every` counts, from the rates of the six modes: that of the planes with a rate (of
   *  several the root of the sum of squares), or else the largest |rate| of a driven edge. If nothing is driven, the
   *  rate of the shear that a stress causes, for the output. */
  double strain_rate(const double rates[number_of_box_modes]) const;

  /** Evaluates variables; errors if their values are not valid. */
  void evaluate_rates(LAMMPS_NS::LAMMPS *lmp);
  void evaluate_targets(LAMMPS_NS::LAMMPS *lmp);

 private:
  void read_edge(Arguments &arguments, int edge);
  void read_shear(Arguments &arguments);
  void read_mean(Arguments &arguments);
  void read_interval(Arguments &arguments, const std::string &keyword);
  void read_gain(Arguments &arguments);
  /** What is understood when all words are read. */
  struct Words {
    int axis = -1;
    Quantity target;
    double ratios[3] = {1.0, 1.0, 1.0};
  };
  void take_axis(const Arguments &errors, const Words &words, const std::set<std::string> &given);
  void take_mean(LAMMPS_NS::LAMMPS *lmp, const Arguments &errors, const Words &words, bool ratio_given);
  void require_consistent(LAMMPS_NS::LAMMPS *lmp, const Arguments &errors, bool every_given);
};

/** Names of the modes: x, y, z, yz, xz, xy. */
const char *name_of_box_mode(int mode);

/** An error that starts with the name of the fix. */
[[noreturn]] void press_strain_error(LAMMPS_NS::LAMMPS *lmp, const std::string &message);

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CHOSEN_AXIS_H
#define GRAINSCOPE_CHOSEN_AXIS_H

#include "scope.h"
#include "symmetry_axis.h"
#include <algorithm>
#include <string>

namespace grainscope {

/** The axis that represents the orientation of a grain, and whether it is the longest axis, as for a prolate grain, or
 *  the shortest, as for an oblate one; without an index if the grain has no such axis. */
inline SymmetryAxis chosen_axis(const double *semi_axes, AxisChoice choice) {
  const SymmetryAxis own = symmetry_axis(semi_axes), none = {Shape::sphere, -1};
  if (choice == AxisChoice::symmetry) return own;
  const Shape wanted = choice == AxisChoice::longest ? Shape::prolate : Shape::oblate;
  if (own.shape == wanted) return own;
  if (own.shape != Shape::triaxial) return none;
  if (choice == AxisChoice::longest) return {Shape::prolate, own.index};
  const int shortest = static_cast<int>(std::min_element(semi_axes, semi_axes + 3) - semi_axes);
  return {Shape::oblate, shortest};
}

/** Warns once of a group with flat and long grains, whose axes mean different things. */
class MixtureWarning {
 public:
  /** `flat` of `all` grains that have an axis. All ranks may call; rank 0 prints. */
  void warn(LAMMPS_NS::LAMMPS *lmp, const std::string &style, const std::string &group, double flat, double all);

 private:
  bool warned_ = false;
};

}

#endif

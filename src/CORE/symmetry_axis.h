// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SYMMETRY_AXIS_H
#define GRAINSCOPE_SYMMETRY_AXIS_H

#include <algorithm>
#include <cmath>

namespace grainscope {

enum class Shape { sphere, prolate, oblate, triaxial };

/** The one rule by which every style finds a grain's symmetry axis from its semi-axes. */
struct SymmetryAxis {
  Shape shape;
  int index;  // body axis 0, 1, 2: of rotation for spheroids, the longest for triaxial grains; -1 for spheres
};

/** Semi-axes within `tolerance` (relative) of each other are equal. */
inline SymmetryAxis symmetry_axis(const double semi_axes[3], double tolerance = 1e-9) {
  const auto equal = [&](int a, int b) {
    return std::fabs(semi_axes[a] - semi_axes[b]) <= tolerance * std::max(semi_axes[a], semi_axes[b]);
  };
  const bool xy = equal(0, 1), yz = equal(1, 2), zx = equal(2, 0);
  if (xy && yz && zx) return {Shape::sphere, -1};
  if (xy || yz || zx) {
    const int axis = xy ? 2 : yz ? 0 : 1;
    return {semi_axes[axis] > semi_axes[(axis + 1) % 3] ? Shape::prolate : Shape::oblate, axis};
  }
  int longest = 0;
  for (int k = 1; k < 3; k++)
    if (semi_axes[k] > semi_axes[longest]) longest = k;
  return {Shape::triaxial, longest};
}

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SPHERE_CONTACT_H
#define GRAINSCOPE_SPHERE_CONTACT_H

#include "ellipsoid_contact.h"
#include <cmath>

namespace grainscope {

/** ellipsoid_contact() of two spheres whose centres are not the same point; d2 = d.d. */
inline EllipsoidContact sphere_contact(double radius1, double radius2, const double d[3], double d2) {
  EllipsoidContact c{};
  const double r = std::sqrt(d2), sum = radius1 + radius2;
  const double inverse_sum = 1.0 / sum;
  c.lambda = radius1 * inverse_sum;
  c.touching = r < sum;
  if (!c.touching) {
    c.gap = r - sum;
    return c;
  }
  const double inverse_r = 1.0 / r, inside = (sum - r) * inverse_sum;
  for (int k = 0; k < 3; k++) {
    c.normal[k] = d[k] * inverse_r;
    c.point[k] = c.lambda * d[k];
  }
  c.depth[0] = radius1 * inside;
  c.depth[1] = radius2 * inside;
  c.curvature[0] = 1.0 / radius1;
  c.curvature[1] = 1.0 / radius2;
  return c;
}

}

#endif

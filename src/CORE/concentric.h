// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONCENTRIC_H
#define GRAINSCOPE_CONCENTRIC_H

#include "ellipsoid_contact.h"
#include "spheroid_pair.h"
#include <algorithm>
#include <cmath>

/** Ellipsoids whose centres are one point, and what the solver takes for their normal. */
namespace grainscope { namespace contact_solver {

inline double smallest_square(const Spheroid &body) { return std::min(body.equatorial_square, body.polar_square); }
inline double smallest_square(const Triaxial &body) { return *std::min_element(body.square, body.square + 3); }

/** Unit vector along a shortest semi-axis. */
inline void shortest_axis(const Spheroid &body, double *n) {
  if (body.polar_square <= body.equatorial_square) {
    std::copy(body.u, body.u + 3, n);
    return;
  }
  int across = 0;  // the coordinate axis that is farthest from the symmetry axis, made perpendicular to it
  for (int k = 1; k < 3; k++)
    if (std::fabs(body.u[k]) < std::fabs(body.u[across])) across = k;
  const double length = root(1.0 - body.u[across] * body.u[across]);
  for (int k = 0; k < 3; k++) n[k] = ((k == across) - body.u[across] * body.u[k]) / length;
}

inline void shortest_axis(const Triaxial &body, double *n) {
  const int least = static_cast<int>(std::min_element(body.square, body.square + 3) - body.square);
  std::copy(body.axis[least], body.axis[least] + 3, n);
}

/** Centres so close that their line has no direction. */
template <class Body>
inline bool concentric(const Body &one, const Body &two, const double *d) {
  return dot(d, d) < 1e-26 * std::min(smallest_square(one), smallest_square(two));
}

inline bool is_sphere(const Spheroid &body) { return body.polar_square == body.equatorial_square; }

}}

#endif

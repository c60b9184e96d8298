// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_QUICK_WALL_TESTS_H
#define GRAINSCOPE_QUICK_WALL_TESTS_H

#include <algorithm>

namespace grainscope {

/** Tests that an ellipsoid (semi-axes s) does not reach a wall, before LIGGGHTS searches for the place where it does.
 *  True only where rounding cannot make the search find one; false decides nothing. Compiled into LIGGGHTS. */

/** The line from a to b, both from the grain's centre along its axes; `inverse` holds 1/s. */
inline bool misses_line(const double *a, const double *b, const double *inverse) {
  double pp = 0.0, pq = 0.0, qq = 0.0;
  for (int k = 0; k < 3; k++) {
    const double p = a[k] * inverse[k], q = (b[k] - a[k]) * inverse[k];
    pp += p * p;
    pq += p * q;
    qq += q * q;
  }
  // least value of |p + t q|^2 for t from 0 to 1
  const double t = qq > 0.0 ? std::min(std::max(-pq / qq, 0.0), 1.0) : 0.0;
  return pp + t * (2.0 * pq + t * qq) > 1.0 + 1e-9 * (1.0 + pp + qq);
}

/** The three edges of a triangle; the grain's axes are the columns of `rotation`, a matrix by rows. */
inline bool misses_edges(const double *const *corners, const double *centre, const double *rotation,
                         const double *inverse) {
  double at[3][3];
  for (int c = 0; c < 3; c++)
    for (int k = 0; k < 3; k++)
      at[c][k] = (corners[c][0] - centre[0]) * rotation[k] + (corners[c][1] - centre[1]) * rotation[3 + k] +
                 (corners[c][2] - centre[2]) * rotation[6 + k];
  return misses_line(at[0], at[1], inverse) && misses_line(at[1], at[2], inverse) && misses_line(at[2], at[0], inverse);
}

/** The plane through a point. */
inline bool misses_plane(const double *normal, const double *point, const double *centre, const double *rotation,
                         const double *s) {
  double reach = 0.0, distance = 0.0;
  for (int k = 0; k < 3; k++) {
    const double along = normal[0] * rotation[k] + normal[1] * rotation[3 + k] + normal[2] * rotation[6 + k];
    reach += along * along * s[k] * s[k];
    distance += normal[k] * (point[k] - centre[k]);
  }
  return distance * distance > (1.0 + 1e-6) * reach;
}

}

#endif

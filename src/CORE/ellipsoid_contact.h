// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ELLIPSOID_CONTACT_H
#define GRAINSCOPE_ELLIPSOID_CONTACT_H

namespace grainscope {

/** A spheroid or sphere in the form of the contact solver: semi-axes a along u and b across it, in any one unit of
 *  length; B = b^2 I + (a^2 - b^2) u u^T. */
struct Spheroid {
  double u[3];                             // unit vector of the symmetry axis
  double equatorial_square, polar_square;  // b^2, a^2
  double inverse_equatorial_square, inverse_polar_square;
  double inverse_product;  // of the three semi-axes
};

/** Any ellipsoid, with B = sum of square[k] axis[k] axis[k]^T. */
struct Triaxial {
  double axis[3][3];  // unit vectors of the principal axes, one per row
  double square[3];   // squares of the semi-axes
};

/** Body axis `k` (0, 1, 2) in the laboratory: a column of the rotation matrix of the unit quaternion (w, x, y, z). */
template <class Real>
inline void rotated_axis(const Real *q, int k, Real *axis) {
  const Real *v = q + 1;
  const int i = k == 2 ? 0 : k + 1, j = k == 0 ? 2 : k - 1;
  axis[k] = 1.0 - 2.0 * (v[i] * v[i] + v[j] * v[j]);
  axis[i] = 2.0 * (v[k] * v[i] + q[0] * v[j]);
  axis[j] = 2.0 * (v[k] * v[j] - q[0] * v[i]);
}

/** From positive semi-axes and the unit quaternion (w, x, y, z) that turns body axes into the laboratory's. */
Spheroid make_spheroid(const double semi_axes[3], const double quaternion[4]);
Triaxial make_triaxial(const double semi_axes[3], const double quaternion[4]);

/** Where two ellipsoids meet. Perram & Wertheim (1985), doi:10.1016/0021-9991(85)90171-8: with C = (1 - lambda) B1 +
 *  lambda B2 and p = C^-1 d, the contact function d.p lambda (1 - lambda) is largest where (1 - lambda) sqrt(p.B1 p) =
 *  lambda sqrt(p.B2 p). That point is also where G1 + G2 is least on G1 = G2, G_k = (x - x_k).B_k^-1 (x - x_k) - 1,
 *  which is LIGGGHTS's definition. */
struct EllipsoidContact {
  bool touching;
  bool fallback;     // no regular result: concentric, not converged, or not a number
  int steps;         // Newton or bisection steps taken, at most ELLIPSOID_STEPS
  double lambda;     // 0 to 1: the start of the next solution
  double normal[3];  // unit vector from 1 to 2
  double point[3];   // contact point from the centre of 1
  double depth[2];   // from the contact point to the surface of 1 along the normal, and to that of 2 against it; >= 0
  double curvature[2];  // root of the Gaussian curvature of each, where that line meets its surface [1/length]
  double gap;           // of ellipsoids that do not touch: a lower bound of their distance; else 0
};

constexpr int ELLIPSOID_STEPS = 60;
constexpr double ELLIPSOID_TOLERANCE = 3e-5;

/** d = x2 - x1. `start` is the lambda of a similar configuration, or 0 for none. The relative error of lambda is about
 *  `tolerance`^3: the last step is carried over to the answer to second order. Normal, point, depth and curvature are
 *  set only for those that touch. */
template <class Body>
EllipsoidContact ellipsoid_contact(const Body &one, const Body &two, const double d[3], double start,
                                   double tolerance = ELLIPSOID_TOLERANCE);

/** Curvatures at a point y on the surface, from the centre: the Gaussian one [1/length^2] and the mean one
 *  [1/length]. */
template <class Body>
double gaussian_curvature(const Body &body, const double y[3]);
template <class Body>
double mean_curvature(const Body &body, const double y[3]);

}

#endif

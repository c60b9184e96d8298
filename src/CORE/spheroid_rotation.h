// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SPHEROID_ROTATION_H
#define GRAINSCOPE_SPHEROID_ROTATION_H

#include "lane_vectors.h"
#include "symmetry_axis.h"
#include <cmath>

/** Rotations of one grain, with Real = double, or of several side by side. */
namespace grainscope {

/** tan(h)/h from h^2, where it is not small. */
inline double library_tangent(double h2, double) {
  const double h = std::sqrt(h2);
  return std::tan(h) / h;
}

constexpr double SMALL_TURN = 1e-3;

/** Likewise; where it is small, by the series. Seldom needed: kept out of the way of what is. */
__attribute__((noinline, cold)) inline void library_tangents(int n, const double *h2, double *ratio) {
  for (int k = 0; k < n; k++)
    if (!(h2[k] < SMALL_TURN)) ratio[k] = library_tangent(h2[k], ratio[k]);
}
GRAINSCOPE_INLINE Lanes library_tangent(Lanes h2, Lanes series) {
  double given[4], ratio[4];
  store(h2, given);
  store(series, ratio);
  library_tangents(4, given, ratio);
  return load(ratio);
}

/** tan(h)/h from h^2. Below h = 0.03 (a turn of 3.6 degrees) by its series, of which the first term left out is below
 *  1e-17. */
template <class Real>
GRAINSCOPE_INLINE Real tan_over_angle(Real h2) {
  const Real series = 1.0 + h2 * (1.0 / 3 + h2 * (2.0 / 15 + h2 * (17.0 / 315 + h2 * (62.0 / 2835))));
  const typename MaskOf<Real>::type small = h2 < SMALL_TURN;
  if (!all(small)) return library_tangent(h2, series);
  return series;
}

/** A rigid body whose moments of inertia are I_u about its body axis k, of direction u, and I_e about every axis across
 *  it. L is its angular momentum; L, u and omega are in the laboratory frame, q (w x y z) turns the body's frame into
 *  it.
 *    omega = L/I_e + (1/I_u - 1/I_e) (L.u) u
 *  Without torque L and L.u are constant: u turns about L at the rate |L|/I_e, and the body about u at (1/I_u - 1/I_e)
 *  (L.u) beside.
 *  Source: Goldstein, Classical Mechanics, ch. 5 (the free symmetric top). */
template <int k, class Real>
class SymmetricTop {
 public:
  GRAINSCOPE_INLINE SymmetricTop(const Real inertia[3], const Real momentum[3], const Real q[4])
      : across_(1.0 / inertia[i]), along_(1.0 / inertia[k] - across_), momentum_(momentum) {
    find_axis(q);
  }

  GRAINSCOPE_INLINE void angular_velocity(Real omega[3]) const {
    const Real along = along_ * momentum_along_axis();
    for (int n = 0; n < 3; n++) omega[n] = across_ * momentum_[n] + along * u_[n];
  }

  /** Turns q by time dt. A turn by the angle 2h about n is the quaternion (1, tan(h) n), normalised; the two turns
   *  commute. */
  GRAINSCOPE_INLINE void rotate(double dt, Real q[4]) {
    const Real *L = momentum_;
    Real half = 0.5 * dt * across_, own = 0.5 * dt * along_ * momentum_along_axis();
    half *= tan_over_angle<Real>(half * half * (L[0] * L[0] + L[1] * L[1] + L[2] * L[2]));
    own *= tan_over_angle<Real>(own * own);

    Real p[4];  // q (1, own e_k)
    p[0] = q[0] - own * q[1 + k];
    p[1 + i] = q[1 + i] + own * q[1 + j];
    p[1 + j] = q[1 + j] - own * q[1 + i];
    p[1 + k] = q[1 + k] + own * q[0];

    const Real x = half * L[0], y = half * L[1], z = half * L[2];
    q[0] = p[0] - x * p[1] - y * p[2] - z * p[3];  // (1, half L) p
    q[1] = p[1] + x * p[0] + y * p[3] - z * p[2];
    q[2] = p[2] + y * p[0] + z * p[1] - x * p[3];
    q[3] = p[3] + z * p[0] + x * p[2] - y * p[1];
    const Real norm2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], scale = 1.0 / root(norm2);
    for (int n = 0; n < 4; n++) q[n] *= scale;
    find_axis(q);
  }

 private:
  static constexpr int i = (k + 1) % 3, j = (k + 2) % 3;
  Real across_, along_, u_[3];
  const Real *momentum_;

  GRAINSCOPE_INLINE Real momentum_along_axis() const {
    return momentum_[0] * u_[0] + momentum_[1] * u_[1] + momentum_[2] * u_[2];
  }

  GRAINSCOPE_INLINE void find_axis(const Real q[4]) {
    u_[i] = 2.0 * (q[1 + k] * q[1 + i] + q[0] * q[1 + j]);
    u_[j] = 2.0 * (q[1 + k] * q[1 + j] - q[0] * q[1 + i]);
    u_[k] = 1.0 - 2.0 * (q[1 + i] * q[1 + i] + q[1 + j] * q[1 + j]);
  }
};

/** Two moments of inertia are equal. (Semi-axes that are equal to 1e-9 give moments that are equal to 2e-9.) */
constexpr double ALIKE = 4e-9;
inline bool is_symmetric_top(const double inertia[3]) { return symmetry_axis(inertia, ALIKE).shape != Shape::triaxial; }

/** Likewise, axis being that across which the moments are the most alike. */
template <class Real>
GRAINSCOPE_INLINE typename MaskOf<Real>::type are_symmetric_about(int axis, const Real inertia[3]) {
  const Real a = inertia[(axis + 1) % 3], b = inertia[(axis + 2) % 3];
  return absolute(a - b) <= ALIKE * pick(a < b, b, a);
}

/** The body axis across which the moments are the most alike: that of symmetry; where all three are equal, any. -1
 *  where those side by side have not the same. */
template <class Real>
GRAINSCOPE_INLINE int axis_of_symmetric_top(const Real inertia[3]) {
  using Mask = typename MaskOf<Real>::type;
  const Real x = absolute(inertia[1] - inertia[2]), y = absolute(inertia[2] - inertia[0]),
             z = absolute(inertia[0] - inertia[1]);
  const Mask about_z = (z <= x) & (z <= y), about_x = (x <= y) & !about_z, about_y = !(about_z | about_x);
  return all(about_z) ? 2 : all(about_x) ? 0 : all(about_y) ? 1 : -1;
}

template <int k, class Real>
GRAINSCOPE_INLINE void rotate_about(const Real inertia[3], const Real momentum[3], double dt, Real q[4],
                                    Real omega[3]) {
  SymmetricTop<k, Real> top(inertia, momentum, q);
  top.rotate(dt, q);
  top.angular_velocity(omega);
}

/** Of symmetric tops whose axis is `axis`. */
template <class Real>
GRAINSCOPE_INLINE void angular_velocity(int axis, const Real inertia[3], const Real momentum[3], const Real q[4],
                                        Real omega[3]) {
  switch (axis) {
    case 0: return SymmetricTop<0, Real>(inertia, momentum, q).angular_velocity(omega);
    case 1: return SymmetricTop<1, Real>(inertia, momentum, q).angular_velocity(omega);
    default: return SymmetricTop<2, Real>(inertia, momentum, q).angular_velocity(omega);
  }
}
template <class Real>
GRAINSCOPE_INLINE void rotate_freely(int axis, const Real inertia[3], const Real momentum[3], double dt, Real q[4],
                                     Real omega[3]) {
  switch (axis) {
    case 0: return rotate_about<0>(inertia, momentum, dt, q, omega);
    case 1: return rotate_about<1>(inertia, momentum, dt, q, omega);
    default: return rotate_about<2>(inertia, momentum, dt, q, omega);
  }
}

/** Angular velocity of a symmetric top, by the formula above. */
inline void angular_velocity(const double inertia[3], const double momentum[3], const double q[4], double omega[3]) {
  angular_velocity(axis_of_symmetric_top(inertia), inertia, momentum, q, omega);
}

/** Turns a symmetric top freely, exactly, by time dt, and gives the angular velocity that it then has. */
inline void rotate_freely(const double inertia[3], const double momentum[3], double dt, double q[4], double omega[3]) {
  rotate_freely(axis_of_symmetric_top(inertia), inertia, momentum, dt, q, omega);
}

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#include "ellipsoid_contact.h"
#include "concentric.h"
#include "ellipsoid_solver.h"
#include "sphere_contact.h"
#include "symmetry_axis.h"
#include <algorithm>
#include <cmath>

namespace grainscope {

namespace {

using namespace contact_solver;

/** Not so where squares of lengths are beyond the range of numbers, or what was given is none. */
inline bool is_sound(const EllipsoidContact &c) {
  if (!c.touching) return c.gap >= 0.0;
  double sum = c.depth[0] + c.depth[1] + c.curvature[0] + c.curvature[1];
  for (double x : c.point) sum += std::fabs(x);
  return std::fabs(dot(c.normal, c.normal) - 1.0) < 1e-9 && c.depth[0] >= 0.0 && c.depth[1] >= 0.0 && sum < HUGE_VAL;
}

/** Of those that do not touch, only what is defined. */
inline EllipsoidContact contact_of(const Answer<double> &answer, bool irregular) {
  EllipsoidContact c{};
  c.touching = answer.touching;
  c.steps = static_cast<int>(answer.steps);
  c.lambda = answer.lambda;
  c.gap = answer.gap;
  if (c.touching) {
    std::copy(answer.normal, answer.normal + 3, c.normal);
    std::copy(answer.point, answer.point + 3, c.point);
    std::copy(answer.depth, answer.depth + 2, c.depth);
    std::copy(answer.curvature, answer.curvature + 2, c.curvature);
  }
  c.fallback = irregular || !is_sound(c);
  return c;
}

template <class Pair, class Body, class Pose>
EllipsoidContact regular_contact(const Body &one, const Body &two, const Pose &pose1, const Pose &pose2,
                                 const double *d, double start, double tolerance) {
  const bool no_direction = concentric(one, two, d);
  double n[3];
  if (no_direction) {  // any would do; theirs is the shortest way out of the thinner one
    const double square1 = smallest_square(one), square2 = smallest_square(two);
    shortest_axis(square1 <= square2 ? one : two, n);
    for (int k = 0; k < 3; k++) n[k] *= 1e-12 * root(std::min(square1, square2));
  }
  Answer<double> answer;
  solve<Pair>(pose1, pose2, no_direction ? n : d, no_direction ? 0.0 : start, tolerance, ELLIPSOID_STEPS, answer);
  return contact_of(answer, answer.unsettled || no_direction);
}

inline SpheroidOf<double> pose_of(const Spheroid &body) {
  return {{body.u[0], body.u[1], body.u[2]}, body.equatorial_square,    body.polar_square,
          body.inverse_equatorial_square,    body.inverse_polar_square, body.inverse_product};
}

}

Spheroid make_spheroid(const double semi_axes[3], const double quaternion[4]) {
  const int axis = symmetry_axis(semi_axes).index, k = std::max(axis, 0);
  const bool sphere = axis < 0;
  Spheroid body;
  rotated_axis(quaternion, k, body.u);
  body.equatorial_square = semi_axes[(k + 1) % 3] * semi_axes[(k + 2) % 3];
  body.polar_square = sphere ? body.equatorial_square : semi_axes[k] * semi_axes[k];
  body.inverse_equatorial_square = 1.0 / body.equatorial_square;
  body.inverse_polar_square = 1.0 / body.polar_square;
  body.inverse_product = body.inverse_equatorial_square * root(body.inverse_polar_square);
  return body;
}

Triaxial make_triaxial(const double semi_axes[3], const double quaternion[4]) {
  Triaxial body;
  for (int k = 0; k < 3; k++) {
    rotated_axis(quaternion, k, body.axis[k]);
    body.square[k] = semi_axes[k] * semi_axes[k];
  }
  return body;
}

template <>
EllipsoidContact ellipsoid_contact(const Spheroid &one, const Spheroid &two, const double d[3], double start,
                                   double tolerance) {
  if (is_sphere(one) && is_sphere(two) && !concentric(one, two, d)) {
    EllipsoidContact c = sphere_contact(root(one.equatorial_square), root(two.equatorial_square), d, dot(d, d));
    c.fallback = !is_sound(c);
    return c;
  }
  return regular_contact<SpheroidPair<double>>(one, two, pose_of(one), pose_of(two), d, start, tolerance);
}

template <>
EllipsoidContact ellipsoid_contact(const Triaxial &one, const Triaxial &two, const double d[3], double start,
                                   double tolerance) {
  return regular_contact<TriaxialPair>(one, two, one, two, d, start, tolerance);
}

/** With g = B^-1 y, half the gradient of y.B^-1 y: K = 1/(det B (g.g)^2), H = (tr(B^-1) g.g - g.B^-1 g)/(2 |g|^3). */
template <>
double gaussian_curvature(const Spheroid &body, const double y[3]) {
  const double t = dot(body.u, y), e = body.equatorial_square, a = body.polar_square;
  const double g2 = across(y, body.u, t) / (e * e) + t * t / (a * a);
  return 1.0 / (e * e * a * g2 * g2);
}

template <>
double gaussian_curvature(const Triaxial &body, const double y[3]) {
  double g2 = 0.0, det = 1.0;
  for (int k = 0; k < 3; k++) {
    const double g = dot(body.axis[k], y) / body.square[k];
    g2 += g * g;
    det *= body.square[k];
  }
  return 1.0 / (det * g2 * g2);
}

template <>
double mean_curvature(const Spheroid &body, const double y[3]) {
  const double t = dot(body.u, y), e = body.equatorial_square, a = body.polar_square;
  const double g2_across = across(y, body.u, t) / (e * e), g2_along = t * t / (a * a), g2 = g2_across + g2_along;
  return (g2_across * (1.0 / e + 1.0 / a) + g2_along * 2.0 / e) / (2.0 * g2 * root(g2));
}

template <>
double mean_curvature(const Triaxial &body, const double y[3]) {
  double g2 = 0.0, weighted = 0.0;
  for (int k = 0; k < 3; k++) {
    const double g = dot(body.axis[k], y) / body.square[k];
    g2 += g * g;
    weighted += g * g * (1.0 / body.square[(k + 1) % 3] + 1.0 / body.square[(k + 2) % 3]);
  }
  return weighted / (2.0 * g2 * root(g2));
}

}

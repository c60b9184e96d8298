// SPDX-License-Identifier: GPL-2.0-or-later
#include "ellipsoid_contact.h"
#include "concentric.h"
#include "sphere_contact.h"
#include "spheroid_pair.h"
#include "symmetry_axis.h"
#include "triaxial_pair.h"
#include <algorithm>
#include <cmath>

namespace grainscope {

namespace {

using namespace contact_solver;

/** EllipsoidContact, or several side by side. */
template <class Real>
struct Answer {
  using Mask = typename MaskOf<Real>::type;
  Mask touching, apart, unsettled;
  Real lambda, normal[3], point[3], depth[2], curvature[2], gap, steps;
};

/** The solver, for one pair or for several side by side; a lane that has found its answer keeps it, whatever the others
 *  still need. Those that have not settled in `most_steps` are `unsettled`, and answered as far as they got. */
template <class Pair>
GRAINSCOPE_INLINE void solve(const typename Pair::Body &one, const typename Pair::Body &two,
                             const typename Pair::Real *d, typename Pair::Real start, double tolerance, int most_steps,
                             Answer<typename Pair::Real> &answer) {
  using Real = typename Pair::Real;
  using Mask = typename MaskOf<Real>::type;
  const Mask cold = !((start > 0.0) & (start < 1.0));
  answer.touching = answer.apart = answer.unsettled = cold & !cold;
  answer.gap = answer.steps = Real{};
  Real lambda = start;
  if (any(cold)) {
    const Real d2 = dot(d, d), h1 = root(support(one, d)), h2 = root(support(two, d));
    lambda = pick(cold, h1 / (h1 + h2), lambda);
    answer.apart = cold & (d2 > h1 + h2);
    answer.gap = pick(answer.apart, (d2 - h1 - h2) / root(d2), answer.gap);
  }
  Mask open = !answer.apart;
  answer.lambda = lambda;
  if (!any(open)) return;

  Pair pair(one, two, d);
  typename Pair::State now, moved, kept;
  Real low{}, high = Real{} + 1.0;
  for (int round = 1;; round++) {
    pair.evaluate(lambda, now);
    if (round == 1) kept = now;
    const Real ab = root(now.support1 * now.support2), sum2 = now.support1 + now.support2 + 2.0 * ab,
               dp = dot(d, now.p);
    const Mask out = open & (dp * dp > sum2);  // p is a separating axis: d.p > a + b, a and b the roots of the supports
    if (any(out)) {
      answer.gap = pick(out, (dp - root(sum2)) / root(dot(now.p, now.p)), answer.gap);
      answer.apart = answer.apart | out;
      open = open & !out;
      if (!any(open)) break;
    }

    // The root of psi = lambda - a/(a+b): linear in lambda for spheres. (Both sides of the step times a b (a + b).)
    const Real m = 1.0 - lambda, off = m * now.support1 - lambda * now.support2 + (m - lambda) * ab;
    low = pick(off > 0.0, lambda, low);
    high = pick(off > 0.0, high, lambda);
    Real product1, product2;
    pair.differentiate(now, product1, product2);
    const Real slope = ab / (ab * sum2 - (product1 * now.support2 - product2 * now.support1)), step = off * slope;
    Real next = lambda + step;
    const Mask settled = open & (absolute(step) <= tolerance * least(lambda, m)),
               bracketed = (next > low) & (next < high);
    if (round == most_steps) answer.unsettled = open & !settled;
    const Mask last = settled | answer.unsettled;
    answer.steps = pick(open, answer.steps + 1.0, answer.steps);
    if (any(last)) {  // the supports there, to second order, tell how far off the root still is
      Real again1, again2;
      pair.differentiate_again(now, again1, again2);
      const Real a2 = now.support1 + step * (2.0 * product1 + step * again1),
                 b2 = now.support2 + step * (2.0 * product2 + step * again2);
      const Real rest = ((1.0 - next) * a2 - next * b2 + (1.0 - 2.0 * next) * root(a2 * b2)) * slope;
      pair.advance(now, pick(settled, step + rest, Real{}), moved);
      keep(last, moved, kept);
      next = pick(settled, next + rest, next);
    }
    lambda = pick(open, pick(bracketed | settled, next, 0.5 * (low + high)), lambda);
    answer.touching = answer.touching | last;
    open = open & !last;
    if (!any(open)) break;
  }
  answer.lambda = lambda;
  if (!any(answer.touching)) return;

  const Real sum = root(kept.support1) + root(kept.support2), dp = dot(d, kept.p), apart = dp - sum;
  const Real length = root(dot(kept.p, kept.p)), inverse_length = 1.0 / length, m = 1.0 - lambda;
  const Mask out = answer.touching & (apart > 0.0);
  answer.gap = pick(out, apart * inverse_length, answer.gap);
  answer.apart = answer.apart | out;
  answer.touching = answer.touching & !out;
  const Real inverse_sum = 1.0 / sum, inside = -apart * inverse_sum * (1.0 + dp * inverse_sum);
  for (int k = 0; k < 3; k++) answer.normal[k] = kept.p[k] * inverse_length;
  pair.point(kept, m, answer.point);
  pair.surface(kept, 0, m, inside, length, inverse_length, answer.depth[0], answer.curvature[0]);
  pair.surface(kept, 1, lambda, inside, length, inverse_length, answer.depth[1], answer.curvature[1]);
}

inline double number(double lane, int) { return lane; }
inline double number(const Lanes &lanes, int k) { return lanes[k]; }

/** Not so where squares of lengths are beyond the range of numbers, or what was given is none. */
inline bool is_sound(const EllipsoidContact &c) {
  if (!c.touching) return c.gap >= 0.0;
  double sum = c.depth[0] + c.depth[1] + c.curvature[0] + c.curvature[1];
  for (double x : c.point) sum += std::fabs(x);
  return std::fabs(dot(c.normal, c.normal) - 1.0) < 1e-9 && c.depth[0] >= 0.0 && c.depth[1] >= 0.0 && sum < HUGE_VAL;
}

/** One lane's answer. Of those that do not touch, only what is defined. */
template <class Real>
GRAINSCOPE_INLINE void unpack(const Answer<Real> &answer, int lane, bool touching, bool unsettled,
                              EllipsoidContact &c) {
  c = EllipsoidContact{};
  c.touching = touching;
  c.steps = static_cast<int>(number(answer.steps, lane));
  c.lambda = number(answer.lambda, lane);
  c.gap = number(answer.gap, lane);
  for (int k = 0; k < 3 && touching; k++) {
    c.normal[k] = number(answer.normal[k], lane);
    c.point[k] = number(answer.point[k], lane);
  }
  for (int k = 0; k < 2 && touching; k++) {
    c.depth[k] = number(answer.depth[k], lane);
    c.curvature[k] = number(answer.curvature[k], lane);
  }
  c.fallback = unsettled || !is_sound(c);
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
  EllipsoidContact c;
  unpack(answer, 0, answer.touching, answer.unsettled || no_direction, c);
  return c;
}

inline SpheroidOf<double> pose_of(const Spheroid &body) {
  return {{body.u[0], body.u[1], body.u[2]}, body.equatorial_square,    body.polar_square,
          body.inverse_equatorial_square,    body.inverse_polar_square, body.inverse_product};
}

inline void set_shape(const Spheroid &body, int lane, SpheroidOf<Lanes> &lanes) {
  for (int c = 0; c < 3; c++) lanes.u[c][lane] = body.u[c];
  lanes.equatorial_square[lane] = body.equatorial_square;
  lanes.polar_square[lane] = body.polar_square;
  lanes.inverse_equatorial_square[lane] = body.inverse_equatorial_square;
  lanes.inverse_polar_square[lane] = body.inverse_polar_square;
  lanes.inverse_product[lane] = body.inverse_product;
}

constexpr double TOLERANCE = 3e-5;
constexpr int LANE_STEPS = 6;  // those that need more are solved again, alone

/** LANES pairs, from spheroids by rows of components. */
GRAINSCOPE_CLONES void solve_lanes(const SpheroidOf<Lanes> &one, const SpheroidOf<Lanes> &two, const Lanes *d,
                                   const Lanes &start, Answer<Lanes> &answer) {
  solve<SpheroidPair<Lanes>>(one, two, d, start, TOLERANCE, LANE_STEPS, answer);
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

void ellipsoid_contacts(int n, const EllipsoidPair *pairs, EllipsoidContact *contacts) {
  for (int first = 0; first < n; first += LANES) {
    const int many = std::min(LANES, n - first);
    if (many < 3) {  // not worth the lanes
      for (int k = first; k < n; k++)
        contacts[k] = ellipsoid_contact(*pairs[k].one, *pairs[k].two, pairs[k].d, pairs[k].start, TOLERANCE);
      return;
    }
    SpheroidOf<Lanes> one, two;
    Lanes d[3], start;
    bool alone[LANES], together = false;
    for (int k = 0; k < LANES; k++) {
      const EllipsoidPair &pair = pairs[first + std::min(k, many - 1)];  // idle lanes repeat the last pair
      for (int c = 0; c < 3; c++) d[c][k] = pair.d[c];
      set_shape(*pair.one, k, one);
      set_shape(*pair.two, k, two);
      start[k] = pair.start;
      alone[k] = (is_sphere(*pair.one) && is_sphere(*pair.two)) || concentric(*pair.one, *pair.two, pair.d);
      together = together || !alone[k];
    }
    Answer<Lanes> answer;
    if (together) solve_lanes(one, two, d, start, answer);
    for (int k = 0; k < many; k++) {
      const EllipsoidPair &pair = pairs[first + k];
      if (alone[k] || answer.unsettled[k])
        contacts[first + k] = ellipsoid_contact(*pair.one, *pair.two, pair.d, pair.start, TOLERANCE);
      else unpack(answer, k, answer.touching[k], false, contacts[first + k]);
    }
  }
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

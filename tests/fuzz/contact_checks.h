// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FUZZ_CONTACT_CHECKS_H
#define GRAINSCOPE_FUZZ_CONTACT_CHECKS_H

#include "ellipsoid_pairs.h"
#include "input.h"
#include <algorithm>
#include <cmath>

namespace fuzz {

using grainscope::EllipsoidContact;

/** Whatever goes in, what comes out is a sound answer or says that it is none. `rounding`: of the normal. */
inline void require_sound(const EllipsoidContact &c, double rounding = 1e-13) {
  require(c.steps >= 0 && c.steps <= grainscope::ELLIPSOID_STEPS, "the search ends", c.steps);
  if (c.fallback) return;
  if (!c.touching) return require(c.gap >= 0.0, "a gap is not negative", c.gap);
  require(finite(c.normal, 3) && finite(c.point, 3), "normal and point are finite");
  const double square = c.normal[0] * c.normal[0] + c.normal[1] * c.normal[1] + c.normal[2] * c.normal[2];
  require_below(std::fabs(square - 1.0), rounding, "the normal is a unit vector");
  for (int k = 0; k < 2; k++) {
    require(c.depth[k] >= 0.0 && std::isfinite(c.depth[k]), "a depth is finite and not negative", c.depth[k]);
    require(c.curvature[k] >= 0.0 && std::isfinite(c.curvature[k]), "a curvature is finite and not negative",
            c.curvature[k]);
  }
}

/** A ratio of semi-axes, 1 rather than so near to it that both forms of the kernel take it for 1 or not (1e-9). */
inline double ratio(Input &input, double from, double to) {
  const double r = input.logarithmic(from, to);
  return std::fabs(r - 1.0) < 4e-9 ? 1.0 : r;
}

/** Ratios of semi-axes up to 20, of sizes up to 100, any unit of length; near to each other as a rule. */
inline GrainPair grain_pair(Input &input, bool triaxial) {
  GrainPair pair;
  const double unit = std::pow(10.0, input.whole(-9, 6)), alpha = ratio(input, 0.05, 20.0);
  for (int side = 0; side < 2; side++) {
    const double size = unit * (side && input.flag() ? input.logarithmic(0.01, 100.0) : 1.0);
    const double own = side && input.flag() ? ratio(input, 0.05, 20.0) : alpha;
    for (int k = 0; k < 3; k++) pair.semi[side][k] = size;
    const int axis = input.whole(0, 2);
    pair.semi[side][axis] *= own;
    if (triaxial) pair.semi[side][(axis + 1) % 3] *= own > 1.0 ? ratio(input, 1.0, own) : ratio(input, own, 1.0);
    input.direction(pair.quaternion[side], 4);
  }
  input.direction(pair.d, 3);
  double reach = 0.0;
  for (int side = 0; side < 2; side++) reach += *std::max_element(pair.semi[side], pair.semi[side] + 3);
  const double away = reach * (input.flag() ? input.uniform(0.0, 1.2) : input.logarithmic(1e-16, 1e3));
  for (double &x : pair.d) x *= away;
  return pair;
}

inline GrainPair exchanged(const GrainPair &pair) {
  GrainPair other = pair;
  for (int k = 0; k < 3; k++) std::swap(other.semi[0][k], other.semi[1][k]);
  for (int k = 0; k < 4; k++) std::swap(other.quaternion[0][k], other.quaternion[1][k]);
  for (double &x : other.d) x = -x;
  return other;
}

/** Relative distance of `x`, from the centre of `side`, to its surface, by G = x.B^-1 x = 1. */
inline double off_surface(const GrainPair &pair, int side, const double *x) {
  double g = 0.0;
  for (int k = 0; k < 3; k++) {
    double axis[3];
    grainscope::rotated_axis(pair.quaternion[side], k, axis);
    const double t = (axis[0] * x[0] + axis[1] * x[1] + axis[2] * x[2]) / pair.semi[side][k];
    g += t * t;
  }
  return std::fabs(std::sqrt(g) - 1.0);
}

/** How far two answers for one contact are apart, in smallest semi-axes; `turned`: the second was found with the grains
 *  exchanged. */
inline double difference(const GrainPair &pair, const EllipsoidContact &a, const EllipsoidContact &b, bool turned) {
  double largest = 0.0;
  for (int k = 0; k < 3; k++) {
    largest = std::max(largest, std::fabs(a.normal[k] - (turned ? -b.normal[k] : b.normal[k])));
    largest =
        std::max(largest, std::fabs(a.point[k] - (turned ? pair.d[k] + b.point[k] : b.point[k])) / pair.smallest());
  }
  for (int k = 0; k < 2; k++)
    largest = std::max(largest, std::fabs(a.depth[k] - b.depth[turned ? 1 - k : k]) / pair.smallest());
  return largest;
}

/** Two answers agree; on whether the grains touch too, but where that hangs on rounding. */
inline void require_alike(const GrainPair &pair, const EllipsoidContact &a, const EllipsoidContact &b, bool turned,
                          const char *what) {
  const auto inside = [&](const EllipsoidContact &c) { return c.touching ? c.depth[0] + c.depth[1] : c.gap; };
  if (a.touching != b.touching) return require_below((inside(a) + inside(b)) / pair.smallest(), 1e-11, what);
  if (a.touching && !a.fallback && !b.fallback) require_below(difference(pair, a, b, turned), 1e-7, what);
}

/** What must hold of any pair, from the contact alone: both surfaces are where it says, it knows no first and second,
 *  and no start. */
template <class Body>
void check_pair(const GrainPair &pair, double start, const double *aside) {
  const EllipsoidContact c = kernel_contact<Body>(pair);
  require_sound(c);
  require_sound(kernel_contact<Body>(pair, start));
  require_alike(pair, c, kernel_contact<Body>(exchanged(pair)), true, "exchanged grains have the same contact");
  if (start > 0.0 && start < 1.0)
    require_alike(pair, c, kernel_contact<Body>(pair, start), false, "a start does not change the contact");
  if (c.touching && !c.fallback) {
    double on_one[3], on_two[3];
    for (int k = 0; k < 3; k++) {
      on_one[k] = c.point[k] + c.depth[0] * c.normal[k];
      on_two[k] = c.point[k] - pair.d[k] - c.depth[1] * c.normal[k];
    }
    // of the larger one's lengths, as the smaller one sees it
    const double rounding = 1e-9 + 1e-12 * pair.largest() / pair.smallest();
    require_below(off_surface(pair, 0, on_one), rounding, "the depth ends on the surface of 1");
    require_below(off_surface(pair, 1, on_two), rounding, "the depth ends on the surface of 2");
  }
  if (!c.touching && std::isfinite(c.gap)) {
    GrainPair moved = pair;
    for (int k = 0; k < 3; k++) moved.d[k] += (1.0 - 1e-9) * c.gap * aside[k];
    const EllipsoidContact after = kernel_contact<Body>(moved);
    if (after.touching)
      require_below((after.depth[0] + after.depth[1]) / pair.smallest(), 1e-11,
                    "no way of the length of the gap makes them touch");
  }
}

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#include "superquadric_pair.h"
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

using namespace grainscope;

namespace {

double distance(const double *a, const double *b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

/** Pairs of one aspect ratio, centres 1e-9 to 0.1 of their distance nearer than at tangency, one in five apart by as
 *  much. LIGGGHTS stops where the gradients of G1 and G2 are within 1e-5 of antiparallel and G1 - G2 within 1e-5 of G1,
 *  or where a step gains less than 0.1 %. An angle of 1e-5 moves the point by 1e-5 of a radius of curvature, which is
 *  up to max(alpha^2, 1/alpha^2) smallest semi-axes. */
void compare(double alpha, bool warm) {
  RandomPairs random(static_cast<unsigned long>(1000 * alpha) + warm);
  const double angle = 1e-5, aside = angle * std::max({1.0, alpha * alpha, 1.0 / (alpha * alpha)});
  for (int n = 0; n < 2000; n++) {
    GrainPair pair;
    for (int k = 0; k < 2; k++) random.spheroid(pair, k, alpha);
    const double shift = random.logarithmic(1e-9, 1e-1) * (n % 5 ? 1.0 : -1.0), smallest = pair.smallest();
    random.place(pair, shift);
    const EllipsoidContact ours = kernel_contact<Spheroid>(pair);

    const PairMotion motion(random, 1e-4 * smallest, 1e-4);
    SuperquadricHistory history;
    if (warm) SuperquadricPair(motion.before(pair)).contact(history);
    SuperquadricPair theirs(pair, &motion);
    if (theirs.contact(history) != ours.touching) {
      EXPECT_LT(std::fabs(shift), aside);
      continue;
    }
    if (!ours.touching) continue;
    EXPECT_LT(distance(theirs.point, ours.point) / smallest, aside);
    EXPECT_LT(distance(theirs.normal, ours.normal), angle);
    EXPECT_NEAR(theirs.overlap / smallest, (ours.depth[0] + ours.depth[1]) / smallest, angle);
    for (int k = 0; k < 2; k++) {
      const double sign = k ? -1.0 : 1.0;
      double y[3];
      for (int i = 0; i < 3; i++) y[i] = ours.point[i] - (k ? pair.d[i] : 0.0) + sign * ours.depth[k] * ours.normal[i];
      Spheroid body;
      make(pair, k, body);
      EXPECT_NEAR(theirs.gaussian_curvature(k) / gaussian_curvature(body, y), 1.0, 4.0 * aside);
    }
  }
}

}

class ellipsoid_host : public ::testing::TestWithParam<double> {};

TEST_P(ellipsoid_host, contacts_are_liggghts_own) { compare(GetParam(), false); }

TEST_P(ellipsoid_host, contacts_are_liggghts_own_with_its_history) { compare(GetParam(), true); }

INSTANTIATE_TEST_SUITE_P(alpha, ellipsoid_host, ::testing::Values(0.05, 0.33, 0.67, 1.0, 1.5, 3.0, 20.0));

// SPDX-License-Identifier: GPL-2.0-or-later
#include "ellipsoid_pairs.h"
#include "side_by_side.h"
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <functional>

using namespace grainscope;
using reference::Quad;

namespace {

// where body z points: z, x
const double UPRIGHT[4] = {1.0, 0.0, 0.0, 0.0}, ALONG_X[4] = {std::sqrt(0.5), 0.0, std::sqrt(0.5), 0.0};

GrainPair pair_of(const double (&semi1)[3], const double (&semi2)[3], double dx, double dy, double dz,
                  const double *q1 = UPRIGHT, const double *q2 = UPRIGHT) {
  GrainPair pair;
  std::copy_n(semi1, 3, pair.semi[0]);
  std::copy_n(semi2, 3, pair.semi[1]);
  std::copy_n(q1, 4, pair.quaternion[0]);
  std::copy_n(q2, 4, pair.quaternion[1]);
  pair.d[0] = dx;
  pair.d[1] = dy;
  pair.d[2] = dz;
  return pair;
}

/** What holds for every contact and every miss: no NaN, a unit normal, depths and gaps not negative, no endless
 *  search. */
void expect_sound(const EllipsoidContact &c) {
  ASSERT_TRUE(c.lambda >= 0.0 && c.lambda <= 1.0) << c.lambda;
  ASSERT_LE(c.steps, ELLIPSOID_STEPS);
  ASSERT_GE(c.gap, 0.0);
  ASSERT_TRUE(std::isfinite(c.gap));
  if (!c.touching) return;
  ASSERT_NEAR(c.normal[0] * c.normal[0] + c.normal[1] * c.normal[1] + c.normal[2] * c.normal[2], 1.0, 1e-14);
  for (int k = 0; k < 3; k++) ASSERT_TRUE(std::isfinite(c.point[k]));
  for (int k = 0; k < 2; k++) ASSERT_TRUE(c.depth[k] >= 0.0 && std::isfinite(c.depth[k])) << c.depth[k];
}

/** Both forms, cold and warm, against known values to `tolerance`. */
template <class Body>
void expect_form(const GrainPair &pair, const double (&normal)[3], const double (&point)[3], double depth1,
                 double depth2, double tolerance) {
  for (double start : {0.0, 0.3, kernel_contact<Body>(pair).lambda}) {
    const EllipsoidContact c = kernel_contact<Body>(pair, start);
    expect_sound(c);
    ASSERT_TRUE(c.touching);
    EXPECT_FALSE(c.fallback);
    for (int k = 0; k < 3; k++) {
      EXPECT_NEAR(c.normal[k], normal[k], tolerance);
      EXPECT_NEAR(c.point[k], point[k], tolerance);
    }
    EXPECT_NEAR(c.depth[0], depth1, tolerance);
    EXPECT_NEAR(c.depth[1], depth2, tolerance);
  }
}

void expect_contact(const GrainPair &pair, const double (&normal)[3], const double (&point)[3], double depth1,
                    double depth2, double tolerance = 1e-14) {
  expect_form<Spheroid>(pair, normal, point, depth1, depth2, tolerance);
  expect_form<Triaxial>(pair, normal, point, depth1, depth2, tolerance);
}

/** Both forms, cold and warm, against quadruple precision; `tolerance` in smallest semi-axes. */
template <class Body>
void expect_exact_form(const GrainPair &pair, double tolerance, bool fallback) {
  const reference::Contact exact = reference::solve(pair.body(0), pair.body(1), pair.d);
  ASSERT_TRUE(exact.proved);
  const double allowed = tolerance * pair.smallest();
  for (double start : {0.0, 0.3, static_cast<double>(exact.lambda)}) {
    const EllipsoidContact c = kernel_contact<Body>(pair, start);
    expect_sound(c);
    EXPECT_EQ(c.fallback, fallback);
    ASSERT_EQ(c.touching, exact.contact < 1) << static_cast<double>(exact.contact - 1);
    if (!c.touching) continue;
    for (int k = 0; k < 3; k++) {
      EXPECT_NEAR(c.normal[k], static_cast<double>(exact.normal[k]), tolerance);
      EXPECT_NEAR(c.point[k], static_cast<double>(exact.point[k]), allowed);
    }
    for (int k = 0; k < 2; k++) EXPECT_NEAR(c.depth[k], static_cast<double>(exact.depth[k]), allowed);
  }
}

void expect_exact(const GrainPair &pair, double tolerance = 1e-10, bool fallback = false) {
  expect_exact_form<Spheroid>(pair, tolerance, fallback);
  expect_exact_form<Triaxial>(pair, tolerance, fallback);
}

void for_both_forms(const GrainPair &pair, const std::function<void(const EllipsoidContact &)> &check) {
  for (double start : {0.0, 0.01, 0.5, 0.99}) {
    check(kernel_contact<Spheroid>(pair, start));
    check(kernel_contact<Triaxial>(pair, start));
  }
}

void expect_concentric(const GrainPair &pair) {
  for_both_forms(pair, [&](const EllipsoidContact &c) {
    expect_sound(c);
    EXPECT_TRUE(c.touching);
    EXPECT_TRUE(c.fallback);
    EXPECT_NEAR(std::min(c.depth[0], c.depth[1]) / pair.smallest(), 1.0, 1e-9);
  });
}

}

TEST(ellipsoid_contact_limits, concentric_are_parted_along_the_shortest_axis_of_the_thinner) {
  expect_concentric(pair_of({1, 1, 0.5}, {1, 1, 0.5}, 0, 0, 0));
  expect_concentric(pair_of({1, 1, 0.5}, {2, 2, 3}, 0, 0, 0));
  expect_concentric(pair_of({1, 1, 3}, {1, 1, 3}, 0, 0, 0));
  expect_concentric(pair_of({1, 1, 1}, {1, 1, 1}, 0, 0, 0));
  expect_concentric(pair_of({1e-9, 1e-9, 1e-9}, {1e-9, 1e-9, 1e-9}, 0, 0, 0));
  expect_concentric(pair_of({1, 1, 20}, {100, 100, 5}, 0, 0, 0, ALONG_X));
}

TEST(ellipsoid_contact_limits, nearly_concentric) {
  RandomPairs random(31);
  for (int n = 0; n < 2000; n++) {
    GrainPair pair;
    const double alpha = random.logarithmic(0.05, 20.0);
    for (int k = 0; k < 2; k++) random.spheroid(pair, k, alpha);
    random.direction(pair.d, 3);
    const double apart = random.logarithmic(1e-15, 1e-8);
    for (double &x : pair.d) x *= apart;
    for_both_forms(pair, [&](const EllipsoidContact &c) {
      expect_sound(c);
      EXPECT_TRUE(c.touching);
      EXPECT_EQ(c.fallback, apart < 1e-13 * pair.smallest());
    });
    if (apart > 1e-13 * pair.smallest()) expect_exact(pair);
  }
}

TEST(ellipsoid_contact_limits, one_inside_the_other) {
  RandomPairs random(32);
  for (int n = 0; n < 1000; n++) {
    GrainPair pair;
    random.spheroid(pair, 0, random.logarithmic(0.05, 20.0));
    random.spheroid(pair, 1, random.logarithmic(0.05, 20.0), 100.0);
    random.direction(pair.d, 3);
    for (double &x : pair.d) x *= 2.0;
    expect_exact(pair, 1e-7);  // the larger's curvature is up to 40,000 small semi-axes
  }
}

TEST(ellipsoid_contact_limits, two_spheres) {
  const double r = 3.0, sum = 2.5 + 1.0;  // d = (2, 1, 2)
  expect_contact(pair_of({2.5, 2.5, 2.5}, {1, 1, 1}, 2, 1, 2), {2 / r, 1 / r, 2 / r},
                 {2 * 2.5 / sum, 2.5 / sum, 2 * 2.5 / sum}, 2.5 * (1 - r / sum), 1.0 - r / sum);
  for_both_forms(pair_of({1.5, 1.5, 1.5}, {1, 1, 1}, 2, 1, 2), [](const EllipsoidContact &c) {
    EXPECT_FALSE(c.touching);
    EXPECT_NEAR(c.gap, 0.5, 1e-14);
  });
}

/** G1 = G2 on the line of centres divides it as the semi-axes that lie along it. */
TEST(ellipsoid_contact_limits, sphere_on_the_pole_and_on_the_equator_of_a_spheroid) {
  for (double alpha : {0.01, 0.05, 0.33, 1.5, 3.0, 20.0, 100.0}) {
    const double pole = (alpha + 1.0) * 0.99, equator = 2.0 * 0.99;
    expect_contact(pair_of({1, 1, alpha}, {1, 1, 1}, 0, 0, pole), {0, 0, 1}, {0, 0, 0.99 * alpha}, 0.01 * alpha, 0.01,
                   1e-14 * (1 + alpha));
    expect_contact(pair_of({1, 1, alpha}, {1, 1, 1}, 0, equator, 0), {0, 1, 0}, {0, 0.99, 0}, 0.01, 0.01);
  }
}

TEST(ellipsoid_contact_limits, stacked_discs) {
  for (double alpha : {0.01, 0.05, 0.33}) {
    expect_contact(pair_of({1, 1, alpha}, {1, 1, alpha}, 0, 0, 1.9 * alpha), {0, 0, 1}, {0, 0, 0.95 * alpha},
                   0.05 * alpha, 0.05 * alpha, 3e-14);
    for (double aside : {1e-12, 1e-8, 1e-4, 0.3})
      expect_exact(pair_of({1, 1, alpha}, {1, 1, alpha}, aside, -aside / 2, 1.8 * alpha));
  }
}

TEST(ellipsoid_contact_limits, parallel_rods) {
  for (double alpha : {3.0, 20.0, 100.0}) {
    expect_contact(pair_of({1, 1, alpha}, {1, 1, alpha}, 1.9, 0, 0), {1, 0, 0}, {0.95, 0, 0}, 0.05, 0.05);
    expect_contact(pair_of({1, 1, alpha}, {1, 1, alpha}, 0, 0, 1.9 * alpha), {0, 0, 1}, {0, 0, 0.95 * alpha},
                   0.05 * alpha, 0.05 * alpha, 1e-15 * alpha * alpha);
    for (double along : {1e-12, 1e-8, 1e-4, 0.5 * alpha})
      expect_exact(pair_of({1, 1, alpha}, {1, 1, alpha}, 1.5, 0.1, along));
  }
}

TEST(ellipsoid_contact_limits, crossed_rods) {
  for (double alpha : {3.0, 20.0, 100.0}) {
    expect_contact(pair_of({1, 1, alpha}, {1, 1, alpha}, 0, 1.9, 0, UPRIGHT, ALONG_X), {0, 1, 0}, {0, 0.95, 0}, 0.05,
                   0.05);
    for (double angle : {1e-12, 1e-8, 1e-4, 0.1, 1.0}) {
      const double turned[4] = {std::cos(0.5 * angle), std::sin(0.5 * angle), 0.0, 0.0};
      expect_exact(pair_of({1, 1, alpha}, {1, 1, alpha}, 1.9, 0, 0, UPRIGHT, turned), 1e-9);
    }
  }
}

TEST(ellipsoid_contact_limits, aspect_ratios_of_a_hundred) {
  for (double alpha : {0.01, 100.0}) {
    RandomPairs random(33);
    for (int n = 0; n < 3000; n++) {
      GrainPair pair;
      for (int k = 0; k < 2; k++) random.spheroid(pair, k, alpha);
      random.place(pair, random.logarithmic(1e-12, 1e-1));
      expect_exact(pair, 2e-9);
    }
  }
}

TEST(ellipsoid_contact_limits, sizes_of_a_hundred_to_one) {
  RandomPairs random(34);
  for (int n = 0; n < 3000; n++) {
    GrainPair pair;
    random.spheroid(pair, 0, random.logarithmic(0.3, 3.0), 100.0);
    random.spheroid(pair, 1, random.logarithmic(0.3, 3.0));
    random.place(pair, random.logarithmic(1e-12, 5e-3));  // up to half the small one
    expect_exact(pair, 1e-9);
  }
}

/** Also across the 1e-9 within which semi-axes count as equal: a sphere of the mean equatorial semi-axis is at most
 *  that far off. */
TEST(ellipsoid_contact_limits, nearly_spheres_are_nearly_as_spheres) {
  RandomPairs random(35);
  for (double off : {1e-6, 1e-7, 1e-8, 1.1e-9, 1.01e-9, 0.99e-9, 0.9e-9, 1e-10, 1e-11, 1e-12, 1e-16})
    for (int n = 0; n < 300; n++) {
      GrainPair sphere, pair;
      for (int k = 0; k < 2; k++) random.spheroid(sphere, k, 1.0);
      random.place(sphere, random.logarithmic(1e-3, 1e-1));
      pair = sphere;
      for (int k = 0; k < 2; k++) pair.semi[k][n % 3] *= 1.0 + (random.uniform() < 0.5 ? -off : off);
      const EllipsoidContact exact = kernel_contact<Spheroid>(sphere);
      for_both_forms(pair, [&](const EllipsoidContact &c) {
        expect_sound(c);
        ASSERT_TRUE(c.touching);
        for (int k = 0; k < 3; k++) {
          EXPECT_NEAR(c.point[k], exact.point[k], 3.0 * off + 1e-14);
          EXPECT_NEAR(c.normal[k], exact.normal[k], 3.0 * off + 1e-14);
        }
        for (int k = 0; k < 2; k++) EXPECT_NEAR(c.depth[k], exact.depth[k], 3.0 * off + 1e-14);
      });
      const EllipsoidContact as_spheroid = kernel_contact<Spheroid>(pair), as_triaxial = kernel_contact<Triaxial>(pair);
      for (int k = 0; k < 3; k++)
        EXPECT_NEAR(as_spheroid.point[k], as_triaxial.point[k], (off < 1e-9 ? off : 0.0) + 1e-14);
    }
}

TEST(ellipsoid_contact_limits, tangent_to_rounding) {
  RandomPairs random(36);
  for (int n = 0; n < 5000; n++) {
    GrainPair pair;
    const double alpha = random.logarithmic(0.05, 20.0);
    for (int k = 0; k < 2; k++) random.spheroid(pair, k, alpha);
    random.place(pair, random.uniform(-4e-16, 4e-16));
    for_both_forms(pair, [&](const EllipsoidContact &c) {
      expect_sound(c);
      EXPECT_LT(c.touching ? c.depth[0] + c.depth[1] : c.gap, 1e-14 * std::max(1.0, alpha));
    });
  }
}

TEST(ellipsoid_contact_limits, far_apart) {
  for (double away : {1e3, 1e6, 1e60})
    for_both_forms(pair_of({1, 1, 20}, {0.01, 0.01, 0.005}, away, 0.3 * away, 0.1 * away, ALONG_X),
                   [&](const EllipsoidContact &c) {
                     expect_sound(c);
                     EXPECT_FALSE(c.touching);
                     EXPECT_LE(c.steps, 1);
                     EXPECT_GT(c.gap, 0.1 * away);
                   });
}

/** Of what is no number one pair and many say that the answer is none. */
TEST(ellipsoid_contact_limits, no_numbers_are_told_as_fallbacks) {
  const double nan = std::nan("");
  for (GrainPair pair : {pair_of({1, 1, 2}, {1, 1, 2}, nan, 0, 0), pair_of({1, 1, 1}, {1, 1, 1}, nan, 0, 0),
                         pair_of({1, 1, nan}, {1, 1, 2}, 1, 0, 0)}) {
    const EllipsoidContact alone = kernel_contact<Spheroid>(pair);
    EXPECT_TRUE(alone.fallback);
    EXPECT_TRUE(kernel_contact<Triaxial>(pair).fallback);
    const Spheroid one = make_spheroid(pair.semi[0], pair.quaternion[0]),
                   two = make_spheroid(pair.semi[1], pair.quaternion[1]);
    const SideBySide::Query query = {one, two, {pair.d[0], pair.d[1], pair.d[2]}, 0.0};
    for (const EllipsoidContact &c : SideBySide(std::vector<SideBySide::Query>(8, query)).contacts())
      EXPECT_TRUE(c.fallback);
  }
}

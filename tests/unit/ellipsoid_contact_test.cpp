// SPDX-License-Identifier: GPL-2.0-or-later
#include "ellipsoid_pairs.h"
#include "side_by_side.h"
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <vector>

using namespace grainscope;
using reference::Quad;

namespace {

using Make = std::function<void(RandomPairs &, GrainPair &)>;

/** Limits of the errors, in units of the smallest semi-axis of the two; of lambda, of the smaller of lambda and 1 -
 *  lambda. */
struct Limits {
  double lambda, point, normal, overlap, curvature;
};

void alike(RandomPairs &random, GrainPair &pair) {
  const double alpha = random.logarithmic(0.05, 20.0);
  for (int k = 0; k < 2; k++) random.spheroid(pair, k, alpha);
}

void mixed(RandomPairs &random, GrainPair &pair) {
  random.spheroid(pair, 0, random.logarithmic(0.05, 20.0));
  random.spheroid(pair, 1, random.logarithmic(0.05, 20.0), random.logarithmic(0.01, 100.0));
}

void triaxial(RandomPairs &random, GrainPair &pair) {
  random.triaxial(pair, 0, 20.0);
  random.triaxial(pair, 1, 20.0, random.logarithmic(0.01, 100.0));
}

/** The last step, up to 3e-5, is carried over to second order: an error of some 3e-14 in lambda, more where C changes
 *  quickly with it. The point moves by as much times the larger semi-axis and the curvature of flat sides: up to 20^2
 *  times the smallest semi-axis, 100 times more in unlike sizes. Twice to three times the largest of 1e7. */
const Limits ALIKE = {2e-11, 5e-11, 1e-11, 1e-10, 1e-10}, MIXED = {1e-11, 1e-9, 5e-12, 1e-10, 3e-11};

/** Decisions agree with the exact ones where |F - 1| is above this many times the distance of 1 to the next number. */
constexpr double BAND = 32.0 * std::numeric_limits<double>::epsilon();

double length(const Quad *a) { return static_cast<double>(reference::root(reference::dot(a, a))); }

double distance(const double *a, const Quad *b) {
  Quad difference[3];
  for (int k = 0; k < 3; k++) difference[k] = a[k] - b[k];
  return length(difference);
}

bool finite(const EllipsoidContact &c) {
  double sum = c.lambda + c.gap + c.depth[0] + c.depth[1];
  for (int k = 0; k < 3; k++) sum += c.normal[k] + c.point[k];
  return std::isfinite(sum);
}

double slightly_off(RandomPairs &random, double lambda) {
  return lambda + 1e-4 * random.uniform(-1.0, 1.0) * std::min(lambda, 1.0 - lambda);
}

/** Roots of the Gaussian curvatures at the two surface points. */
void exact_curvatures(const GrainPair &pair, const reference::Contact &exact, double *curvatures) {
  for (int k = 0; k < 2; k++) {
    Quad y[3], gaussian, mean;
    const Quad along = k ? -exact.depth[1] : exact.depth[0];
    for (int i = 0; i < 3; i++) y[i] = exact.point[i] + along * exact.normal[i] - (k ? pair.d[i] : 0.0);
    reference::curvatures(pair.body(k), y, gaussian, mean);
    curvatures[k] = static_cast<double>(reference::root(gaussian));
  }
}

struct Worst {
  double lambda = 0.0, point = 0.0, normal = 0.0, overlap = 0.0, curvature = 0.0, wrong = 0.0;
  int cold_steps = 0, warm_steps = 0, failed = 0;

  static void raise(double &largest, double value) {
    if (!(value <= largest)) largest = value;
  }

  void add(const EllipsoidContact &c, const reference::Contact &exact, const double *curvatures, double smallest) {
    const bool touching = exact.contact < 1;
    if (!finite(c) || c.fallback || !exact.proved) failed++;
    if (c.touching != touching) raise(wrong, std::fabs(static_cast<double>(exact.contact - 1)));
    if (!c.touching || !touching) return;
    const double end = static_cast<double>(exact.lambda < Quad(0.5) ? exact.lambda : 1 - exact.lambda);
    raise(lambda, std::fabs(static_cast<double>(c.lambda - exact.lambda)) / end);
    raise(point, distance(c.point, exact.point) / smallest);
    raise(normal, distance(c.normal, exact.normal));
    for (int k = 0; k < 2; k++) {
      raise(overlap, std::fabs(static_cast<double>(c.depth[k] - exact.depth[k])) / smallest);
      raise(curvature, std::fabs(c.curvature[k] / curvatures[k] - 1.0));
    }
  }

  /** A pair by one form of the kernel, cold and from a lambda of a while ago. */
  template <class Body>
  void solve(const GrainPair &pair, const reference::Contact &exact, const double *curvatures, double start) {
    const double smallest = pair.smallest();
    const EllipsoidContact cold = kernel_contact<Body>(pair), warm = kernel_contact<Body>(pair, start);
    add(cold, exact, curvatures, smallest);
    add(warm, exact, curvatures, smallest);
    cold_steps = std::max(cold_steps, cold.steps);
    warm_steps = std::max(warm_steps, warm.steps);
  }

  void expect(const Limits &limits, const char *name) const {
    SCOPED_TRACE(name);
    EXPECT_EQ(failed, 0);
    EXPECT_LT(wrong, BAND);
    EXPECT_LT(lambda, limits.lambda);
    EXPECT_LT(point, limits.point);
    EXPECT_LT(normal, limits.normal);
    EXPECT_LT(overlap, limits.overlap);
    EXPECT_LT(curvature, limits.curvature);
    EXPECT_LE(cold_steps, 10);
    EXPECT_LE(warm_steps, 3);
    std::printf(
        "%s: lambda %.1e, point %.1e, normal %.1e, overlap %.1e, curvature %.1e, wrong decisions up to |F - 1| = %.1e, "
        "steps %d cold, %d warm\n",
        name, lambda, point, normal, overlap, curvature, wrong, cold_steps, warm_steps);
  }
};

/** Nine in ten touch, with centres 1e-12 to 0.1 nearer than at tangency, some much deeper; the rest are apart by as
 *  little, or tangent to rounding. */
double any_shift(RandomPairs &random) {
  const double kind = random.uniform();
  if (kind < 0.8) return random.logarithmic(1e-12, 1e-1);
  if (kind < 0.9) return random.uniform(0.1, 0.99);
  if (kind < 0.95) return -random.logarithmic(1e-14, 1.0);
  return random.uniform(-1e-14, 1e-14);
}

void compare(const char *name, unsigned long seed, long pairs, const Make &make, bool spheroids, const Limits &limits) {
  RandomPairs random(seed);
  Worst worst;
  for (long n = 0; n < pairs; n++) {
    GrainPair pair;
    make(random, pair);
    random.place(pair, any_shift(random));
    const reference::Contact exact = reference::solve(pair.body(0), pair.body(1), pair.d);
    const double start = slightly_off(random, static_cast<double>(exact.lambda));
    double curvatures[2];
    exact_curvatures(pair, exact, curvatures);
    if (spheroids) worst.solve<Spheroid>(pair, exact, curvatures, start);
    worst.solve<Triaxial>(pair, exact, curvatures, start);
  }
  worst.expect(limits, name);
}

void compare_all(unsigned long seed, long pairs) {
  compare("alike", seed, pairs * 4 / 10, alike, true, ALIKE);
  compare("mixed", seed + 1, pairs * 3 / 10, mixed, true, MIXED);
  compare("triaxial", seed + 2, pairs * 3 / 10, triaxial, false, MIXED);
}

template <class Body>
class ellipsoid_form : public ::testing::Test {};
using Forms = ::testing::Types<Spheroid, Triaxial>;

}

TEST(ellipsoid_contact, is_that_of_quadruple_precision) { compare_all(1, 100000); }

TEST(ellipsoid_contact_long, is_that_of_quadruple_precision) { compare_all(1001, 10000000); }

TEST(ellipsoid_contact, reference_meets_the_definition) {
  RandomPairs random(11);
  for (const Make &make : {Make(alike), Make(mixed), Make(triaxial)})
    for (int n = 0; n < 500; n++) {
      GrainPair pair;
      make(random, pair);
      random.place(pair, any_shift(random));
      const reference::Body one = pair.body(0), two = pair.body(1);
      const reference::Contact exact = reference::solve(one, two, pair.d);
      ASSERT_TRUE(exact.proved);
      Quad from_two[3], gradient[2][3], across[3], surface[2][3], unused[3];
      for (int k = 0; k < 3; k++) from_two[k] = exact.point[k] - pair.d[k];
      const Quad g1 = one.shape(exact.point, gradient[0]), g2 = two.shape(from_two, gradient[1]);
      EXPECT_LT(std::fabs(static_cast<double>((g1 - g2) / (1 + g1))), 1e-22);  // G1 = G2
      for (auto &g : gradient) reference::normalise(g);
      reference::cross(gradient[0], gradient[1], across);
      EXPECT_LT(length(across), 1e-20);  // antiparallel gradients: G1 + G2 is least on G1 = G2
      EXPECT_LT(static_cast<double>(reference::dot(gradient[0], gradient[1])), 0.0);
      if (exact.contact > 1) continue;
      for (int k = 0; k < 3; k++) {
        surface[0][k] = exact.point[k] + exact.depth[0] * exact.normal[k];
        surface[1][k] = from_two[k] - exact.depth[1] * exact.normal[k];
      }
      EXPECT_LT(std::fabs(static_cast<double>(one.shape(surface[0], unused))), 1e-22);
      EXPECT_LT(std::fabs(static_cast<double>(two.shape(surface[1], unused))), 1e-22);
      EXPECT_GE(static_cast<double>(exact.depth[0]), 0.0);
      EXPECT_GE(static_cast<double>(exact.depth[1]), 0.0);
    }
}

TYPED_TEST_SUITE(ellipsoid_form, Forms);

TYPED_TEST(ellipsoid_form, same_from_any_start) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  RandomPairs random(21);
  for (int n = 0; n < 3000; n++) {
    GrainPair pair;
    (n % 2 ? alike : mixed)(random, pair);
    random.place(pair, random.logarithmic(1e-6, 1e-1) * (n % 10 ? 1.0 : -1.0));
    const Limits &limits = n % 2 ? ALIKE : MIXED;
    const EllipsoidContact cold = kernel_contact<TypeParam>(pair);
    for (double start : {nan, -nan, infinity, -infinity, -1.0, -1e-300, 1e-300, 1e-20, 1e-5, 0.5, random.uniform(),
                         1.0 - 1e-5, 1.0 - 1e-16, 1.0, 7.0}) {
      const EllipsoidContact warm = kernel_contact<TypeParam>(pair, start);
      ASSERT_TRUE(finite(warm)) << start;
      ASSERT_EQ(warm.touching, cold.touching) << start;
      ASSERT_FALSE(warm.fallback) << start;
      ASSERT_LE(warm.steps, 30) << start;
      if (!cold.touching) continue;
      const double end = std::min(cold.lambda, 1.0 - cold.lambda), smallest = pair.smallest();
      EXPECT_NEAR(warm.lambda, cold.lambda, 2.0 * limits.lambda * end) << start;
      for (int k = 0; k < 3; k++) {
        EXPECT_NEAR(warm.point[k], cold.point[k], 2.0 * limits.point * smallest) << start;
        EXPECT_NEAR(warm.normal[k], cold.normal[k], 2.0 * limits.normal) << start;
      }
      for (int k = 0; k < 2; k++) EXPECT_NEAR(warm.depth[k], cold.depth[k], 2.0 * limits.overlap * smallest) << start;
    }
  }
}

TYPED_TEST(ellipsoid_form, same_with_the_two_swapped) {
  RandomPairs random(22);
  for (int n = 0; n < 10000; n++) {
    GrainPair pair, back;
    mixed(random, pair);
    random.place(pair, random.logarithmic(1e-12, 1e-1) * (n % 10 ? 1.0 : -1.0));
    for (int k = 0; k < 2; k++) {
      std::copy_n(pair.semi[1 - k], 3, back.semi[k]);
      std::copy_n(pair.quaternion[1 - k], 4, back.quaternion[k]);
    }
    for (int k = 0; k < 3; k++) back.d[k] = -pair.d[k];
    const EllipsoidContact there = kernel_contact<TypeParam>(pair);
    const EllipsoidContact warm = kernel_contact<TypeParam>(back, 1.0 - there.lambda);
    for (const EllipsoidContact &c : {kernel_contact<TypeParam>(back), warm}) {
      ASSERT_EQ(c.touching, there.touching);
      if (!c.touching) continue;
      const double end = std::min(there.lambda, 1.0 - there.lambda), smallest = pair.smallest();
      EXPECT_NEAR(c.lambda, 1.0 - there.lambda, 2.0 * MIXED.lambda * end);
      for (int k = 0; k < 3; k++) {
        EXPECT_NEAR(c.normal[k], -there.normal[k], 2.0 * MIXED.normal);
        EXPECT_NEAR(c.point[k], there.point[k] - pair.d[k], 2.0 * MIXED.point * smallest);
      }
      for (int k = 0; k < 2; k++) EXPECT_NEAR(c.depth[k], there.depth[1 - k], 2.0 * MIXED.overlap * smallest);
    }
    EXPECT_LE(warm.steps, 1);
  }
}

TYPED_TEST(ellipsoid_form, turns_with_the_two) {
  RandomPairs random(23);
  for (int n = 0; n < 10000; n++) {
    GrainPair pair, turned;
    alike(random, pair);
    random.place(pair, random.logarithmic(1e-4, 1e-1));
    turned = pair;
    double q[4], axis[3][3];
    random.direction(q, 4);
    for (int k = 0; k < 3; k++) rotated_axis(q, k, axis[k]);
    const auto turn = [&](const double *v, int k) { return axis[0][k] * v[0] + axis[1][k] * v[1] + axis[2][k] * v[2]; };
    for (int k = 0; k < 3; k++) turned.d[k] = turn(pair.d, k);
    for (int i = 0; i < 2; i++) {
      const double *p = pair.quaternion[i];
      const double product[4] = {
          q[0] * p[0] - q[1] * p[1] - q[2] * p[2] - q[3] * p[3], q[0] * p[1] + q[1] * p[0] + q[2] * p[3] - q[3] * p[2],
          q[0] * p[2] + q[2] * p[0] + q[3] * p[1] - q[1] * p[3], q[0] * p[3] + q[3] * p[0] + q[1] * p[2] - q[2] * p[1]};
      std::copy_n(product, 4, turned.quaternion[i]);
    }
    const EllipsoidContact a = kernel_contact<TypeParam>(pair), b = kernel_contact<TypeParam>(turned);
    ASSERT_TRUE(a.touching && b.touching);
    for (int k = 0; k < 3; k++) {
      EXPECT_NEAR(b.point[k], turn(a.point, k), 2.0 * ALIKE.point * pair.smallest());
      EXPECT_NEAR(b.normal[k], turn(a.normal, k), 2.0 * ALIKE.normal);
    }
    for (int k = 0; k < 2; k++) EXPECT_NEAR(b.depth[k], a.depth[k], 2.0 * ALIKE.overlap * pair.smallest());
  }
}

/** Powers of two change no digit: from 1e-9 to 1e9 every result is the same to the last one. */
TYPED_TEST(ellipsoid_form, same_in_any_unit) {
  RandomPairs random(24);
  for (int n = 0; n < 3000; n++) {
    GrainPair pair;
    mixed(random, pair);
    random.place(pair, random.logarithmic(1e-12, 1e-1) * (n % 5 ? 1.0 : -1.0));
    const EllipsoidContact here = kernel_contact<TypeParam>(pair);
    for (double unit : {std::ldexp(1.0, -30), std::ldexp(1.0, 30), std::ldexp(1.0, -80), std::ldexp(1.0, 80)}) {
      GrainPair scaled = pair;
      for (int k = 0; k < 3; k++) {
        scaled.d[k] *= unit;
        for (auto &semi : scaled.semi) semi[k] *= unit;
      }
      const EllipsoidContact there = kernel_contact<TypeParam>(scaled);
      ASSERT_EQ(there.touching, here.touching);
      EXPECT_EQ(there.steps, here.steps);
      EXPECT_EQ(there.lambda, here.lambda);
      EXPECT_EQ(there.gap, unit * here.gap);
      for (int k = 0; k < 3; k++) {
        EXPECT_EQ(there.normal[k], here.normal[k]);
        EXPECT_EQ(there.point[k], unit * here.point[k]);
      }
      for (int k = 0; k < 2; k++) EXPECT_EQ(there.depth[k], unit * here.depth[k]);
    }
  }
}

/** Decisions close to tangency: of the pairs apart or overlapping by less than 1e-12, none outside BAND is
 *  decided wrongly. */
TYPED_TEST(ellipsoid_form, decides_as_exact_arithmetic_does) {
  RandomPairs random(25);
  int decided = 0;
  for (int n = 0; n < 20000; n++) {
    GrainPair pair;
    (n % 2 ? alike : mixed)(random, pair);
    random.place(pair, random.logarithmic(1e-15, 1e-12) * (random.uniform() < 0.5 ? -1.0 : 1.0));
    const reference::Body one = pair.body(0), two = pair.body(1);
    const Quad scale = reference::scale_of_tangency(one, two, pair.d);
    const double off = static_cast<double>(scale * scale - 1);
    if (std::fabs(off) < BAND) continue;
    decided++;
    const double start = slightly_off(random, reference::rough_lambda(one, two, pair.d));
    EXPECT_EQ(kernel_contact<TypeParam>(pair).touching, off < 0.0) << off;
    EXPECT_EQ(kernel_contact<TypeParam>(pair, start).touching, off < 0.0) << off;
  }
  EXPECT_GT(decided, 15000);
}

/** For any direction n, the points of the two surfaces that are farthest along n and -n are no nearer to each other
 *  than the surfaces. */
TYPED_TEST(ellipsoid_form, gap_is_a_lower_bound_of_the_distance) {
  RandomPairs random(26);
  for (int n = 0; n < 1000; n++) {
    GrainPair pair;
    (n % 2 ? alike : mixed)(random, pair);
    random.place(pair, -random.logarithmic(1e-10, 10.0));
    const reference::Body one = pair.body(0), two = pair.body(1);
    const reference::Contact exact = reference::solve(one, two, pair.d);
    Quad nearest = 0, direction[3] = {exact.normal[0], exact.normal[1], exact.normal[2]};
    for (int k = 0; k < 60; k++) {
      Quad from[3], to[3], between[3], back[3] = {-direction[0], -direction[1], -direction[2]};
      one.support(direction, from);
      two.support(back, to);
      for (int i = 0; i < 3; i++) between[i] = pair.d[i] + to[i] - from[i];
      const Quad square = reference::dot(between, between);
      if (k == 0 || square < nearest) nearest = square;
      reference::normalise(between);
      for (int i = 0; i < 3; i++) direction[i] += between[i] / (2 + k);
      reference::normalise(direction);
    }
    const double distance = static_cast<double>(reference::root(nearest)), size = length(exact.point) + pair.smallest();
    for (double start : {0.0, static_cast<double>(exact.lambda), random.uniform()}) {
      const EllipsoidContact c = kernel_contact<TypeParam>(pair, start);
      ASSERT_FALSE(c.touching);
      EXPECT_GT(c.gap, 0.0);
      EXPECT_LE(c.gap, distance * (1.0 + 1e-12) + 1e-14 * size);
    }
  }
}

TYPED_TEST(ellipsoid_form, curvatures_are_those_of_the_fundamental_forms) {
  RandomPairs random(27);
  for (int n = 0; n < 20000; n++) {
    GrainPair pair;
    if (std::is_same<TypeParam, Triaxial>::value) random.triaxial(pair, 0, 20.0, random.logarithmic(1e-3, 1e3));
    else random.spheroid(pair, 0, random.logarithmic(0.05, 20.0), random.logarithmic(1e-3, 1e3));
    const reference::Body exact = pair.body(0);
    double w[3], y[3];
    random.direction(w, 3);
    Quad at[3] = {0, 0, 0}, gaussian, mean;
    for (int i = 0; i < 3; i++)
      for (int k = 0; k < 3; k++) at[k] += exact.semi[i] * w[i] * exact.axis[i][k];
    for (int k = 0; k < 3; k++) y[k] = static_cast<double>(at[k]);
    reference::curvatures(exact, at, gaussian, mean);
    TypeParam body;
    make(pair, 0, body);
    // y is rounded: 1e-16 of the longest semi-axis
    EXPECT_NEAR(gaussian_curvature(body, y) / static_cast<double>(gaussian), 1.0, 5e-13);
    EXPECT_NEAR(mean_curvature(body, y) / static_cast<double>(mean), 1.0, 5e-13);
  }
}

/** Touching, apart, spheres, concentric, cold and warm, in any mixture and number: what each gives alone, to the last
 *  bit. */
TEST(ellipsoid_contact, is_the_same_side_by_side) {
  RandomPairs random(41);
  for (int round = 0; round < 3000; round++) {
    const int n = 1 + round % 37;
    std::vector<SideBySide::Query> queries(n);
    for (SideBySide::Query &query : queries) {
      GrainPair pair;
      const double kind = random.uniform();
      if (kind < 0.1)
        for (int i = 0; i < 2; i++) random.spheroid(pair, i, 1.0);
      else (kind < 0.5 ? alike : mixed)(random, pair);
      random.place(pair, random.logarithmic(1e-12, 1.0) * (random.uniform() < 0.6 ? 1.0 : -1.0));
      if (random.uniform() < 0.02) std::fill_n(pair.d, 3, 0.0);
      const double lambda = kernel_contact<Spheroid>(pair).lambda, start = random.uniform();
      make(pair, 0, query.one);
      make(pair, 1, query.two);
      std::copy_n(pair.d, 3, query.d);
      query.start = start < 0.3 ? 0.0 : start < 0.4 ? random.uniform(-0.1, 1.1) : slightly_off(random, lambda);
    }
    SideBySide many(queries);
    const std::vector<EllipsoidContact> together = many.contacts();
    for (int k = 0; k < n; k++) {
      const SideBySide::Query &query = many.queries()[k];
      const EllipsoidContact alone = ellipsoid_contact(query.one, query.two, query.d, query.start);
      ASSERT_EQ(together[k].touching, alone.touching);
      ASSERT_EQ(together[k].fallback, alone.fallback);
      ASSERT_EQ(together[k].steps, alone.steps);
      ASSERT_EQ(together[k].lambda, alone.lambda);
      ASSERT_EQ(together[k].gap, alone.gap);
      for (int i = 0; i < 3; i++) {
        ASSERT_EQ(together[k].normal[i], alone.normal[i]);
        ASSERT_EQ(together[k].point[i], alone.point[i]);
      }
      for (int i = 0; i < 2; i++) {
        ASSERT_EQ(together[k].depth[i], alone.depth[i]);
        ASSERT_EQ(together[k].curvature[i], alone.curvature[i]);
      }
    }
  }
}

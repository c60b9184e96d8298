// SPDX-License-Identifier: GPL-2.0-or-later
#include "spheroid_motion.h"
#include "spheroid_rotation.h"
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace {

const int group = 2;
const double half = 0.01, dt = 0.02;

/** Grains at random. Their turns in a step are of 0.02 rad or so: by the series. */
struct Grains {
  int n;
  std::vector<int> mask;
  std::vector<double> mass, inertia, force, torque, x, v, momentum, quaternion, omega;

  explicit Grains(
      int n, const std::function<int(int)> &axis = [](int) { return 2; })
      : n(n), mask(n, 1 | group), mass(numbers(n)), inertia(3 * n, 2.0), force(numbers(3 * n)), torque(numbers(3 * n)),
        x(numbers(3 * n)), v(numbers(3 * n)), momentum(numbers(3 * n)), quaternion(numbers(4 * n)),
        omega(numbers(3 * n)) {
    for (double &m : mass) m += 2.0;
    for (int i = 0; i < n; i++) inertia[3 * i + axis(i)] = i % 2 ? 1.3 : 3.1;
  }

  void kick() { grainscope::kick(from(0, n), half); }
  void kick_and_drift() { grainscope::kick_and_drift(from(0, n), half, dt); }
  void kick_each() {
    for (int i = 0; i < n; i++) grainscope::kick(from(i, 1), half);
  }
  void kick_and_drift_each() {
    for (int i = 0; i < n; i++) grainscope::kick_and_drift(from(i, 1), half, dt);
  }

  /** To the last bit, and in what is not a number. */
  bool operator==(const Grains &other) const {
    const auto same = [](const std::vector<double> &a, const std::vector<double> &b) {
      for (std::size_t k = 0; k < a.size(); k++)
        if (std::memcmp(&a[k], &b[k], sizeof a[k]) && !(std::isnan(a[k]) && std::isnan(b[k]))) return false;
      return a.size() == b.size();
    };
    return same(x, other.x) && same(v, other.v) && same(momentum, other.momentum) &&
           same(quaternion, other.quaternion) && same(omega, other.omega);
  }

 private:
  static std::vector<double> numbers(int n) {
    static std::mt19937 random(7);
    std::uniform_real_distribution<> uniform(-1.0, 1.0);
    std::vector<double> some(n);
    for (double &one : some) one = uniform(random);
    return some;
  }

  grainscope::Spheroids from(int i, int many) {
    const int k = 3 * i;
    return {many,       group, &mask[i], &mass[i],     &inertia[k],        &force[k],
            &torque[k], &x[k], &v[k],    &momentum[k], &quaternion[4 * i], &omega[k]};
  }
};

void expect_same(Grains grains, const std::string &what) {
  Grains each = grains;
  for (int step = 0; step < 3; step++) {
    grains.kick_and_drift();
    each.kick_and_drift_each();
    EXPECT_TRUE(grains == each) << what << ", drift " << step;
    grains.kick();
    each.kick_each();
    EXPECT_TRUE(grains == each) << what << ", kick " << step;
  }
}

}

TEST(spheroid_motion, is_a_kick_and_a_free_rotation) {
  Grains grains(5);
  const Grains before = grains;
  grains.kick_and_drift();
  for (int i = 0; i < grains.n; i++) {
    double momentum[3], q[4], omega[3];
    for (int k = 0; k < 3; k++) {
      const int at = 3 * i + k;
      const double v = before.v[at] + half * before.force[at] / before.mass[i];
      momentum[k] = before.momentum[at] + half * before.torque[at];
      EXPECT_NEAR(grains.v[at], v, 1e-15);
      EXPECT_NEAR(grains.x[at], before.x[at] + dt * v, 1e-15);
      EXPECT_NEAR(grains.momentum[at], momentum[k], 1e-15);
    }
    std::copy_n(&before.quaternion[4 * i], 4, q);
    grainscope::rotate_freely(&before.inertia[3 * i], momentum, dt, q, omega);
    for (int k = 0; k < 4; k++) EXPECT_NEAR(grains.quaternion[4 * i + k], q[k], 1e-15);
    for (int k = 0; k < 3; k++) EXPECT_NEAR(grains.omega[3 * i + k], omega[k], 1e-15);
  }
}

TEST(spheroid_motion, side_by_side_is_one_by_one_to_the_last_bit) {
  for (int axis = 0; axis < 3; axis++)
    for (int n = 1; n < 14; n++)
      expect_same(Grains(n, [axis](int) { return axis; }), std::to_string(n) + " about " + std::to_string(axis));
}

TEST(spheroid_motion, neighbours_may_turn_about_other_axes) {
  expect_same(Grains(64, [](int i) { return i % 3; }), "in turn");
  expect_same(Grains(64, [](int i) { return i / 7 % 3; }), "seven at a time");
  for (int odd = 0; odd < 12; odd++)
    for (int axis = 0; axis < 3; axis++)
      expect_same(Grains(12, [=](int i) { return i == odd ? axis : 1; }), "one of twelve");
  Grains balls(12);
  balls.inertia.assign(balls.inertia.size(), 0.4);
  expect_same(balls, "balls");
}

TEST(spheroid_motion, grains_of_other_groups_stay_as_they_are) {
  for (int still = 0; still < 12; still++) {
    Grains grains(12);
    grains.mask[still] = 1;
    const Grains before = grains;
    expect_same(grains, "one at rest");
    grains.kick_and_drift();
    grains.kick();
    for (int k = 3 * still; k < 3 * still + 3; k++) {
      EXPECT_EQ(grains.x[k], before.x[k]);
      EXPECT_EQ(grains.v[k], before.v[k]);
      EXPECT_EQ(grains.omega[k], before.omega[k]);
    }
  }
  Grains none(12);
  none.mask.assign(12, 1);
  const Grains before = none;
  none.kick_and_drift();
  EXPECT_TRUE(none == before);
}

TEST(spheroid_motion, large_turns_and_rest_beside_small_turns) {
  for (double size : {0.0, 1e-200, 1e2, 1e5, 1e200})
    for (int other = 0; other < 8; other++) {
      Grains grains(8);
      for (int k = 3 * other; k < 3 * other + 3; k++) {
        grains.momentum[k] *= size;
        grains.torque[k] = 0.0;
      }
      expect_same(grains, std::to_string(size));
    }
  Grains grains(16);
  for (double &l : grains.momentum) l *= 40.0;
  expect_same(grains, "all");
}

TEST(spheroid_motion, what_is_no_number_stays_with_its_grain) {
  for (double broken : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (int other = 0; other < 8; other++) {
      Grains grains(8);
      grains.torque[3 * other + 1] = broken;
      expect_same(grains, "torque");
      grains.kick_and_drift();
      for (int i = 0; i < 8; i++) EXPECT_EQ(std::isfinite(grains.quaternion[4 * i]), i != other);
    }
}

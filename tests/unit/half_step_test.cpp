// SPDX-License-Identifier: GPL-2.0-or-later
#include "half_step.h"
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>
#include <random>

using namespace grainscope;
using Eigen::AngleAxisd;
using Eigen::Map;
using Eigen::Vector3d;
using half_step::Moment;
using half_step::Motion;

namespace {

struct Random {
  std::mt19937 engine{7};
  std::uniform_real_distribution<double> numbers{-1.0, 1.0};
  double number() { return numbers(engine); }
  Vector3d vector() {
    const double x = number(), y = number();
    return {x, y, number()};
  }
  Vector3d unit() { return vector().normalized(); }
};

void set(double *to, const Vector3d &v) { Map<Vector3d>{to} = v; }

constexpr double rounding = 1e-14;

/** Two unit vectors less than 60 degrees apart: of a middle and of the end of its step. */
void random_normals(Random &random, Moment<double> &middle, Vector3d &end) {
  const Vector3d first = random.unit();
  set(middle.normal, first);
  end = AngleAxisd(1.0 * random.number(), first.cross(random.unit()).normalized()) * first;
}

Motion<double> random_motion(Random &random) {
  Motion<double> m;
  set(m.velocity, random.vector());
  set(m.spin_i, random.vector());
  set(m.spin_j, random.vector());
  return m;
}

}

TEST(half_step, turns_velocities_as_the_shortest_rotation) {
  Random random;
  for (int k = 0; k < 1000; k++) {
    Moment<double> middle;
    Vector3d end, found;
    random_normals(random, middle, end);
    set(middle.arm_i, random.vector());
    set(middle.arm_j, random.vector());
    const Motion<double> m = random_motion(random);
    const Map<const Vector3d> normal(middle.normal);
    const Vector3d v = Map<const Vector3d>(m.velocity) +
                       Map<const Vector3d>(m.spin_i).cross(Map<const Vector3d>(middle.arm_i)) -
                       Map<const Vector3d>(m.spin_j).cross(Map<const Vector3d>(middle.arm_j));
    half_step::relative_velocity(middle, m, false, end.data(), found.data());
    const Vector3d expected = Eigen::Quaterniond::FromTwoVectors(Vector3d(normal), end) * v;
    EXPECT_LT((found - expected).norm(), rounding * 10.0);
    EXPECT_NEAR(found.norm(), v.norm(), rounding * 10.0);
    EXPECT_NEAR(found.dot(end), v.dot(normal), rounding * 10.0);  // approach stays approach
  }
}

TEST(half_step, turns_springs_from_the_normal_at_the_beginning_to_that_at_the_end) {
  Random random;
  for (int k = 0; k < 1000; k++) {
    Moment<double> middle;
    Vector3d end;
    random_normals(random, middle, end);
    const Vector3d normal = Map<const Vector3d>(middle.normal), start = 2.0 * end.dot(normal) * normal - end;
    const Vector3d spring = start.cross(random.unit());
    Vector3d found = spring;
    half_step::turn_spring(middle, found.data());
    const Vector3d expected = Eigen::Quaterniond::FromTwoVectors(start, end) * spring;
    EXPECT_LT((found - expected).norm(), rounding * 10.0);
    EXPECT_NEAR(found.dot(end), 0.0, rounding * 10.0);
    EXPECT_NEAR(found.norm(), spring.norm(), rounding * 10.0);
  }
}

TEST(half_step, middle_of_spheres_is_the_mean_of_both_ends) {
  Random random;
  for (int k = 0; k < 1000; k++) {
    const Motion<double> m = random_motion(random);
    const double dt = 0.1, ri = 1.0 + 0.5 * random.number(), rj = 1.0 + 0.5 * random.number();
    const Vector3d end = 0.99 * (ri + rj) * random.unit(), start = end - dt * Map<const Vector3d>(m.velocity),
                   half = 0.5 * (start + end), normal = end.normalized();
    Moment<double> middle;
    half_step::middle_of_spheres(normal.data(), end.data(), ri, rj, m, dt, middle);
    EXPECT_LT((Map<const Vector3d>(middle.normal) - half.normalized()).norm(), rounding);
    // From either centre to one point, which halves the overlap.
    EXPECT_LT((Map<const Vector3d>(middle.arm_j) - Map<const Vector3d>(middle.arm_i) - half).norm(), rounding * 10.0);
    const double lever_i = Map<const Vector3d>(middle.arm_i).norm(), lever_j = Map<const Vector3d>(middle.arm_j).norm();
    EXPECT_NEAR(ri - lever_i, rj - lever_j, rounding * 10.0);
  }
}

/** Two grains that turn about an axis as one body do not move against each other; what is left is of second order. With
 *  the normal of the end of the step it would be of first. */
TEST(half_step, what_turns_as_one_body_does_not_slip) {
  Random random;
  for (int k = 0; k < 100; k++) {
    const Vector3d spin = random.vector(), branch = 2.0 * random.unit();
    double errors[2];
    for (int fine = 0; fine < 2; fine++) {
      const double dt = fine ? 0.05 : 0.1;
      const Vector3d start = AngleAxisd(-spin.norm() * dt, spin.normalized()) * branch, normal = 0.5 * branch;
      Motion<double> m;
      set(m.velocity, (branch - start) / dt);
      set(m.spin_i, spin);
      set(m.spin_j, spin);
      Moment<double> middle;
      Vector3d u;
      half_step::middle_of_spheres(normal.data(), branch.data(), 1.0, 1.0, m, dt, middle);
      half_step::relative_velocity(middle, m, false, normal.data(), u.data());
      errors[fine] = u.norm();
    }
    EXPECT_LT(errors[0], 0.01);  // (spin dt)^2/12 of the speed
    EXPECT_LT(errors[1], 0.26 * errors[0] + rounding);
  }
}

TEST(half_step, keeps_what_it_needs_for_the_next_step) {
  Random random;
  for (bool wall : {false, true})
    for (int k = 0; k < 1000; k++) {
      const double dt = 0.01;
      const Motion<double> m = random_motion(random);
      const Vector3d v = Map<const Vector3d>(m.velocity), point_before = random.vector(), point = random.vector();
      Moment<double> before, now, middle, fresh;
      const Vector3d n = random.unit(), branch = random.vector();
      set(before.normal, AngleAxisd(0.3 * random.number(), random.unit()) * n);
      set(now.normal, n);
      set(before.arm_i, point_before);
      set(now.arm_i, point);
      set(before.arm_j, point_before + branch - dt * v);
      set(now.arm_j, point + branch);
      double kept[half_step::kept_numbers] = {};
      half_step::middle_of_kept(kept, now, wall, m, dt, fresh);  // nothing is kept yet
      EXPECT_EQ(Map<const Vector3d>(fresh.normal), n);
      EXPECT_EQ(Map<const Vector3d>(fresh.arm_i), point);
      half_step::keep(before, wall, m.spin_i, kept);
      EXPECT_EQ(Map<const Vector3d>(kept + half_step::kept_velocity), Map<const Vector3d>(m.spin_i));
      half_step::middle_of_kept(kept, now, wall, m, dt, middle);
      const Vector3d sum = Map<const Vector3d>(before.normal) + n;
      EXPECT_LT((Map<const Vector3d>(middle.normal) - sum.normalized()).norm(), rounding);
      EXPECT_LT((Map<const Vector3d>(middle.arm_i) - 0.5 * (point_before + point)).norm(), rounding);
      if (wall) continue;
      const Vector3d mean = 0.5 * (Map<const Vector3d>(before.arm_j) + Map<const Vector3d>(now.arm_j));
      EXPECT_LT((Map<const Vector3d>(middle.arm_j) - mean).norm(), rounding);
      // As j sees it: what is kept changes its sign, or does not, as TimeLevel says.
      double turned[half_step::kept_numbers];
      Moment<double> from_j{}, of_j;
      set(from_j.normal, -n);
      set(from_j.arm_i, Map<const Vector3d>(now.arm_j));
      set(from_j.arm_j, Map<const Vector3d>(now.arm_i));
      Motion<double> motion = m;
      set(motion.velocity, -v);
      for (int c = 0; c < half_step::kept_numbers; c++) turned[c] = c / 3 == 1 ? kept[c] : -kept[c];
      half_step::middle_of_kept(turned, from_j, wall, motion, dt, of_j);
      EXPECT_LT((Map<const Vector3d>(of_j.arm_i) - Map<const Vector3d>(middle.arm_j)).norm(), rounding);
      EXPECT_LT((Map<const Vector3d>(of_j.normal) + Map<const Vector3d>(middle.normal)).norm(), rounding);
    }
}

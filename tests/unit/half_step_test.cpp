// SPDX-License-Identifier: GPL-2.0-or-later
#include "half_step.h"
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <utility>

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

constexpr double rounding = 1e-13;

/** Of the middle and of the end of a step: unit vectors less than 60 degrees apart. */
struct Normals {
  Vector3d half, end;
  explicit Normals(Random &random) : half(random.unit()) {
    end = AngleAxisd(random.number(), half.cross(random.unit()).normalized()) * half;
  }
};

struct Moves {
  Vector3d velocity, spin_i, spin_j;
  explicit Moves(Random &random) : velocity(random.vector()), spin_i(random.vector()), spin_j(random.vector()) {}
  Motion<double> motion() const {
    Motion<double> m;
    set(m.velocity, velocity);
    set(m.spin_i, spin_i);
    set(m.spin_j, spin_j);
    return m;
  }
  Vector3d of_surfaces(const Vector3d &arm_i, const Vector3d &arm_j) const {
    return velocity + spin_i.cross(arm_i) - spin_j.cross(arm_j);
  }
};

Vector3d turned(const Vector3d &from, const Vector3d &to, const Vector3d &v) {
  return Eigen::Quaterniond::FromTwoVectors(from, to) * v;
}

struct Touch {
  Vector3d normal, arm_i, arm_j;
  Moment<double> moment() const {
    Moment<double> m;
    set(m.normal, normal);
    set(m.arm_i, arm_i);
    set(m.arm_j, arm_j);
    return m;
  }
};

}

TEST(half_step, turns_velocities_as_the_shortest_rotation) {
  Random random;
  for (int k = 0; k < 1000; k++) {
    const Normals n(random);
    const Vector3d v = random.vector();
    Vector3d found;
    half_step::turn(n.half.data(), n.end.data(), v.data(), found.data());
    EXPECT_LT((found - turned(n.half, n.end, v)).norm(), rounding);
    EXPECT_NEAR(found.dot(n.end), v.dot(n.half), rounding);  // approach stays approach
  }
}

TEST(half_step, turns_springs_from_the_normal_at_the_beginning_to_that_at_the_end) {
  Random random;
  for (int k = 0; k < 1000; k++) {
    const Normals n(random);
    const Vector3d start = 2.0 * n.end.dot(n.half) * n.half - n.end, spring = start.cross(random.unit());
    Vector3d found = spring;
    half_step::turn_spring(n.half.data(), found.data());
    EXPECT_LT((found - turned(start, n.end, spring)).norm(), rounding);
    EXPECT_NEAR(found.dot(n.end), 0.0, rounding);
  }
}

/** The places of spheres in the middle are the mean of both ends, and the contact point halves their overlap. */
TEST(half_step, of_spheres) {
  Random random;
  for (int k = 0; k < 1000; k++) {
    const Moves m(random);
    const double dt = 0.1, ri = 1.0 + 0.5 * random.number(), rj = 1.0 + 0.5 * random.number();
    const Vector3d end = 0.99 * (ri + rj) * random.unit(), start = end - dt * m.velocity, middle = 0.5 * (start + end),
                   n = middle.normalized(), normal = end.normalized();
    const double overlap = ri + rj - middle.norm();
    const Vector3d u = m.of_surfaces(-(ri - 0.5 * overlap) * n, (rj - 0.5 * overlap) * n);
    Vector3d half, found;
    half_step::of_spheres(normal.data(), end.data(), ri, rj, m.motion(), dt, half.data(), found.data());
    EXPECT_LT((half - n).norm(), rounding);
    EXPECT_LT((found - turned(n, normal, u)).norm(), rounding);
  }
}

/** Two grains that turn about an axis as one body do not move against each other; what is left is of second order. With
 *  the normal of the end of the step it would be of first. */
TEST(half_step, what_turns_as_one_body_does_not_slip) {
  Random random;
  for (int k = 0; k < 100; k++) {
    const Vector3d spin = random.vector(), branch = 2.0 * random.unit(), normal = 0.5 * branch;
    double errors[2];
    for (int fine = 0; fine < 2; fine++) {
      const double dt = fine ? 0.05 : 0.1;
      Moves m(random);
      m.velocity = (branch - AngleAxisd(-spin.norm() * dt, spin.normalized()) * branch) / dt;
      m.spin_i = m.spin_j = spin;
      Vector3d half, u;
      half_step::of_spheres(normal.data(), branch.data(), 1.0, 1.0, m.motion(), dt, half.data(), u.data());
      errors[fine] = u.norm();
    }
    EXPECT_LT(errors[0], 0.01);  // (spin dt)^2/12 of the speed
    EXPECT_LT(errors[1], 0.26 * errors[0] + rounding);
  }
}

/** Normal and arms in the middle are the means of both ends; of a contact that is new, those of the end. */
TEST(half_step, of_what_was_kept) {
  Random random;
  const double dt = 0.01;
  for (bool wall : {false, true})
    for (int k = 0; k < 1000; k++) {
      Moves m(random);
      if (wall) m.spin_j.setZero();
      const Vector3d branch = random.vector(), n = random.unit();
      Touch before, now;
      before.normal = AngleAxisd(0.3 * random.number(), random.unit()) * n;
      before.arm_i = random.vector();
      before.arm_j = before.arm_i + branch - dt * m.velocity;
      now = {n, random.vector(), {}};
      now.arm_j = now.arm_i + branch;
      double kept[half_step::kept_numbers] = {};
      Vector3d half, found;
      half_step::of_kept(before.moment(), wall, m.motion(), dt, kept, half.data(), found.data());
      EXPECT_EQ(half, before.normal);
      EXPECT_LT((found - m.of_surfaces(before.arm_i, before.arm_j)).norm(), rounding);
      EXPECT_EQ(Map<const Vector3d>(kept + half_step::kept_velocity), found);
      double others[half_step::kept_numbers];  // as j keeps it, and as TimeLevel::add_columns() has it
      for (int c = 0; c < half_step::kept_numbers; c++) others[c] = c / 3 == 1 ? kept[c] : -kept[c];

      half_step::of_kept(now.moment(), wall, m.motion(), dt, kept, half.data(), found.data());
      const Vector3d middle = (before.normal + n).normalized(),
                     u = m.of_surfaces(0.5 * (before.arm_i + now.arm_i), 0.5 * (before.arm_j + now.arm_j));
      EXPECT_LT((half - middle).norm(), rounding);
      EXPECT_LT((found - turned(middle, n, u)).norm(), rounding);
      if (wall) continue;
      Moves from_j = m;
      from_j.velocity = -m.velocity;
      std::swap(from_j.spin_i, from_j.spin_j);
      const Touch seen{-n, now.arm_j, now.arm_i};
      Vector3d half_j, found_j;
      half_step::of_kept(seen.moment(), wall, from_j.motion(), dt, others, half_j.data(), found_j.data());
      EXPECT_LT((half_j + half).norm(), rounding);
      EXPECT_LT((found_j + found).norm(), rounding);
    }
}

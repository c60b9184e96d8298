// SPDX-License-Identifier: GPL-2.0-or-later
#include "remembered_grains.h"
#include <gtest/gtest.h>
#include <random>

using namespace remembered_grains;

namespace {

struct Random {
  std::mt19937_64 engine;
  explicit Random(int seed) : engine(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
  Vector3d vector(double size) {
    std::normal_distribution<double> normal;
    return size * Vector3d(normal(engine), normal(engine), normal(engine));
  }
  Quaterniond turn(double size) {
    const Vector3d axis = vector(1.0).normalized();
    return Quaterniond(Eigen::AngleAxisd(size, axis));
  }
};

/** Two rods along z, side by side along x, `gap` apart. */
Grains rods(double gap) {
  Grains g;
  g.x = {Vector3d(0, 0, 0), Vector3d(2.0 + gap, 0, 0)};
  g.q = {Quaterniond::Identity(), Quaterniond::Identity()};
  g.shape = {{1.0, 1.0, 5.0}, {1.0, 1.0, 5.0}};
  g.list(12.0);
  g.look(0);
  return g;
}

}

/** Shapes, motions, turns, jumps and boxes of all kinds, each alone and all together: whatever touches is looked at,
 *  and nothing is left out for longer than it would take to cross its distance. */
TEST(separation_memory, never_overlooks_a_contact) {
  int touching = 0, left_out = 0, looked_at = 0;
  for (int trial = 0; trial < 200; trial++) {
    Random random(trial);
    Grains g;
    enum { turns_only, drift_only, flow_only, everything };
    const int kind = trial % 4;
    const double size = 4.0,
                 speed = kind == drift_only || kind == everything ? std::pow(10.0, random.uniform(-1.5, 0.0)) : 0.0;
    const double spin = kind == turns_only || kind == everything ? std::pow(10.0, random.uniform(-1.5, 0.0)) : 0.0;
    const double strain = kind == flow_only || kind == everything ? std::pow(10.0, random.uniform(-2.0, -1.0)) : 0.0;
    const double jumps = kind == everything ? 0.02 : 0.0;
    g.origin = random.vector(1.0);
    g.edges = 10.0 * (Matrix3d::Identity() + 0.3 * Matrix3d(random.vector(1.0).asDiagonal()));
    g.edges(0, 1) = random.uniform(-5.0, 5.0);
    for (int i = 0; i < 12; i++) {
      g.x.push_back(g.origin + random.vector(size));
      g.q.push_back(random.turn(random.uniform(0.0, 6.0)));
      const double a = random.uniform(0.5, 1.5), b = trial % 2 ? a : random.uniform(0.3, 1.5),
                   c = random.uniform(0.1, 4.0);
      g.shape.push_back(trial % 5 ? std::array<double, 3>{a, b, c} : std::array<double, 3>{a, a, a});
    }
    g.list(10.0);
    Matrix3d flow = Matrix3d::Zero();
    for (int k = 0; k < 3; k++) flow.row(k) = random.vector(strain);
    std::vector<Vector3d> drift;
    std::vector<Quaterniond> turns;
    for (int i = 0; i < 12; i++) {
      drift.push_back(random.vector(speed));
      turns.push_back(random.turn(random.uniform(0.0, spin)));
    }
    bool within_reach = true;  // as long as neighbour lists are valid
    for (int step = 0; step < 60 && within_reach; step++) {
      for (std::size_t k = 0; k < g.pairs.size() && within_reach; k++) {
        const bool looks = g.may_touch(k), touches = g.contact(k).touching;
        ASSERT_TRUE(looks || !touches) << "trial " << trial << ", step " << step << ", pair " << k;
        touching += touches;
        left_out += !looks;
        looked_at += looks;
        if (looks) g.look(k);
        if (looks || step % 4) continue;
        ASSERT_TRUE(g.memory.may_touch(k, g.motion(k) + g.distance(k)))
            << "trial " << trial << ", step " << step << ", pair " << k;
      }
      const Matrix3d f = Matrix3d::Identity() + flow;
      for (int i = 0; i < 12; i++) {
        g.x[i] = g.origin + f * (g.x[i] - g.origin) + drift[i];
        g.q[i] = (turns[i] * g.q[i]).normalized();
        if (random.uniform(0.0, 1.0) < jumps) g.x[i] += random.vector(0.5);
        if (random.uniform(0.0, 1.0) < jumps) g.q[i] = random.turn(random.uniform(0.0, 3.0)) * g.q[i];
        if (random.uniform(0.0, 1.0) < jumps) g.q[i].coeffs() *= -1.0;  // the same orientation
      }
      g.edges = f * g.edges;
      const Vector3d shift = random.vector(0.1);
      g.origin += shift;  // the box moves, the grains do not
      g.move();
      for (const Grains::Pair &pair : g.pairs)
        within_reach = within_reach && (g.x[pair.i] - g.x[pair.j]).norm() < 1.5 * g.reach;
    }
  }
  EXPECT_GT(touching, 5000);
  EXPECT_GT(left_out, looked_at);
}

/** One moves head on: left out until the gap is used up, to the margin of 1e-6. */
TEST(separation_memory, a_gap_is_used_up_by_what_closes_it) {
  Grains g = rods(0.5);
  g.x[1].x() -= 0.49999;
  g.move();
  EXPECT_FALSE(g.may_touch(0));
  g.x[1].x() -= 0.00001;
  g.move();
  EXPECT_TRUE(g.may_touch(0));
}

TEST(separation_memory, motion_adds_up_over_steps_and_grains) {
  Grains g = rods(0.5);
  for (int step = 1; step <= 10; step++) {
    g.x[0].y() += 0.03 * (step % 2 ? 1 : -1);  // to and fro: path length counts
    g.x[1].z() += 0.021;
    g.move();
    EXPECT_EQ(g.may_touch(0), 0.051 * step >= 0.5 * (1.0 - 1e-6)) << step;
  }
}

/** A rod turned by phi reaches up to (5 - 1) phi farther; a sphere's turns do not count. */
TEST(separation_memory, turns_count_by_the_elongation) {
  Grains g = rods(0.5);
  g.q[0] = Quaterniond(Eigen::AngleAxisd(0.12, Vector3d::UnitY()));
  g.move();
  EXPECT_FALSE(g.may_touch(0));
  EXPECT_NEAR(g.memory.moved(0), 4.0 * 0.12, 1e-3);
  g.q[0] = Quaterniond(Eigen::AngleAxisd(0.13, Vector3d::UnitY()));
  g.move();
  EXPECT_TRUE(g.may_touch(0));

  g.shape = {{1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}};
  g.q[0] = Quaterniond::Identity();
  g.list(12.0);
  g.look(0);
  g.q[0] = Quaterniond(Eigen::AngleAxisd(3.0, Vector3d::UnitY()));
  g.move();
  EXPECT_EQ(g.memory.moved(0), 0.0);
  EXPECT_FALSE(g.may_touch(0));
}

/** A spheroid by its axis, a triaxial grain by its quaternion. */
TEST(separation_memory, large_turns_count_in_full) {
  for (double angle = 0.1; angle < 3.14; angle += 0.1)
    for (double width : {1.0, 1.1}) {
      Grains g = rods(0.5);
      g.shape = {{1.0, width, 5.0}, {1.0, 1.0, 5.0}};
      g.list(12.0);
      g.look(0);
      g.q[0] = Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitY()));
      g.move();
      EXPECT_GE(g.memory.moved(0), 4.0 * angle);
      EXPECT_LE(g.memory.moved(0), 4.0 * angle * 1.2);
    }
}

/** A spheroid that spins about its axis brings nothing nearer. */
TEST(separation_memory, spin_of_a_spheroid_about_its_axis_does_not_count) {
  Grains g = rods(0.5);
  g.q[0] = Quaterniond(Eigen::AngleAxisd(2.0, Vector3d::UnitZ()));
  g.move();
  EXPECT_NEAR(g.memory.moved(0), 0.0, 1e-14);
}

/** Grains of one shape, more than are followed at a time. */
TEST(separation_memory, every_grain_of_many_is_followed) {
  Grains g;
  for (int i = 0; i < 203; i++) {
    g.x.push_back(Vector3d(20.0 * i, 0, 0));
    g.q.push_back(Quaterniond::Identity());
    g.shape.push_back({1.0, 1.0, 5.0});
  }
  g.list(12.0);
  for (int i = 0; i < 203; i++) {
    g.x[i].y() += 1e-3 * i;
    g.q[i] = Quaterniond(Eigen::AngleAxisd(1e-4 * i, Vector3d::UnitX()));
  }
  g.move();
  for (int i = 0; i < 203; i++) EXPECT_NEAR(g.memory.moved(i), 1e-3 * i + 4e-4 * i, 1e-5 * i) << i;
  EXPECT_EQ(g.memory.most_moved(), g.memory.moved(202));
}

/** Grains that go with the box's flow use up only the strain times their distance; the box's own translation costs
 *  nothing. */
TEST(separation_memory, affine_motion_costs_little) {
  Grains g = rods(0.5);
  g.origin = Vector3d(-1e3, -1e3, -1e3);  // a large box: grains move by strain times 1000
  g.edges = 2e3 * Matrix3d::Identity();
  g.list(12.0);
  g.look(0);
  Matrix3d f = Matrix3d::Identity();
  f(0, 1) = 0.01;
  for (Vector3d &x : g.x) x = g.origin + f * (x - g.origin);
  g.edges = f * g.edges;
  g.move();
  EXPECT_NEAR(g.motion(0), 1.5 * 12.0 * 0.01, 1e-9);
  EXPECT_FALSE(g.may_touch(0));
}

TEST(separation_memory, a_new_list_knows_nothing) {
  Grains g = rods(0.5);
  EXPECT_FALSE(g.may_touch(0));
  g.list(12.0);
  EXPECT_TRUE(g.may_touch(0));
}

TEST(separation_memory, what_touches_is_always_looked_at) {
  Grains g = rods(-0.1);
  EXPECT_TRUE(g.contact(0).touching);
  EXPECT_TRUE(g.may_touch(0));
  g.memory.set_apart(0, 1e-12, g.motion(0));  // as good as touching
  EXPECT_TRUE(g.may_touch(0));
}

/** Any number of grains, side by side or not: each has moved by its displacement against the flow and its turn, and
 *  hardly more. */
TEST(separation_memory, motion_is_at_least_the_true_one_of_every_grain) {
  for (int count = 1; count < 12; count++) {
    Random random(count);
    Grains g;
    g.edges = 10.0 * Matrix3d::Identity();
    for (int i = 0; i < count; i++) {
      g.x.push_back(random.vector(4.0));
      g.q.push_back(random.turn(random.uniform(0.0, 6.0)));
      g.shape.push_back({1.0, 1.0, i % 3 ? random.uniform(0.1, 4.0) : 1.0});
    }
    g.list(10.0);
    EXPECT_EQ(g.memory.most_moved(), 0.0);
    std::vector<double> displaced(count), turned(count);
    double strained = 0.0;
    for (int step = 0; step < 5; step++) {
      Matrix3d f = Matrix3d::Identity();
      for (int k = 0; k < 3; k++) f.row(k) += random.vector(0.02);
      const Vector3d shift = random.vector(0.3);
      strained += 0.75 * g.reach * (f - Matrix3d::Identity()).norm();
      double most = 0.0;
      for (int i = 0; i < count; i++) {
        const Vector3d flown = g.origin + shift + f * (g.x[i] - g.origin), drift = random.vector(0.2);
        const Vector3d axis = g.q[i] * Vector3d::UnitZ();
        g.x[i] = flown + drift;
        g.q[i] = random.turn(random.uniform(0.0, 1.0)) * g.q[i];
        const Vector3d axis_now = g.q[i] * Vector3d::UnitZ();
        displaced[i] += drift.norm();
        turned[i] += std::abs(g.shape[i][2] - 1.0) * std::atan2(axis.cross(axis_now).norm(), axis.dot(axis_now));
      }
      g.edges = f * g.edges;
      g.origin += shift;
      g.move();
      for (int i = 0; i < count; i++) {
        const double least = strained + displaced[i] + turned[i];
        EXPECT_GE(g.memory.moved(i), least * (1.0 - 1e-12)) << count << " grains, " << i;
        EXPECT_LE(g.memory.moved(i), least + 0.2 * turned[i] + 1e-12) << count << " grains, " << i;
        most = std::max(most, g.memory.moved(i));
      }
      EXPECT_EQ(g.memory.most_moved(), most);
    }
  }
}

/** may_touch() asks about now, may_touch_before() about all motions up to one that is still to come. */
TEST(separation_memory, tells_until_when_a_pair_is_apart) {
  Grains g = rods(0.5);
  for (double motion : {0.0, 0.2, 0.4999}) {
    EXPECT_FALSE(g.memory.may_touch(0, motion));
    EXPECT_FALSE(g.memory.may_touch_before(0, motion));
  }
  EXPECT_TRUE(g.memory.may_touch(0, 0.5));
  EXPECT_TRUE(g.memory.may_touch_before(0, 0.5));
  g.memory.set_touching(0);
  EXPECT_TRUE(g.memory.may_touch(0, 0.0));
  EXPECT_TRUE(g.memory.may_touch_before(0, 0.0));
}

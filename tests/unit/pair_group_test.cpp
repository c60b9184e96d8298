// SPDX-License-Identifier: GPL-2.0-or-later
#include "packed_pairs.h"
#include "sphere_contact.h"
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <vector>

using namespace packed_pairs;
using reference::Quad;

namespace {

/** Nothing is told of places without a pair of their own. */
void expect_idle(const PairGroup &group, const GroupGeometry &g) {
  for (int k = group.size; k < LANES; k++)
    EXPECT_FALSE(g.reachable[k] || g.touching[k] || g.apart[k] || g.met[k] || g.alone[k]);
}

void expect_place(const Scene &scene, const PairGroup &group, const GroupGeometry &g, int k) {
  double d[3];
  scene.place(group, k, d);
  const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2],
               reach = scene.grains[group.i[k]].reach + scene.grains[group.j[k]].reach;
  for (int l = 0; l < 3; l++) ASSERT_EQ(g.d[l][k], d[l]);
  ASSERT_EQ(g.square[k], square);
  ASSERT_EQ(bool(g.reachable[k]), square < reach * reach);
  ASSERT_TRUE(!g.touching[k] || g.reachable[k]);
  if (g.reachable[k]) return;
  ASSERT_EQ(g.gap[k], std::sqrt(square) - scene.grains[group.i[k]].reach - scene.grains[group.j[k]].reach);
}

/** The same contact, to the last bit. */
void expect_contact(const EllipsoidContact &c, const GroupGeometry &g, int k) {
  ASSERT_EQ(bool(g.touching[k]), c.touching);
  ASSERT_EQ(bool(g.apart[k]), !c.touching);
  ASSERT_EQ(g.lambda[k], c.lambda);
  ASSERT_EQ(g.steps[k], c.steps);
  if (!c.touching) {
    ASSERT_EQ(g.gap[k], c.gap);
    return;
  }
  for (int l = 0; l < 3; l++) {
    ASSERT_EQ(g.normal[l][k], c.normal[l]);
    ASSERT_EQ(g.point[l][k], c.point[l]);
  }
  for (int l = 0; l < 2; l++) {
    ASSERT_EQ(g.depth[l][k], c.depth[l]);
    ASSERT_EQ(g.curvature[l][k], c.curvature[l]);
  }
}

int sum(LaneMask mask) { return -static_cast<int>(mask[0] + mask[1] + mask[2] + mask[3]); }

/** Two spheroids of any sizes and shapes, spheres among them, packed alone. */
struct TwoGrains {
  std::vector<PackedGrain> grains = std::vector<PackedGrain>(2);
  std::vector<PackedShape> shapes;
  Spheroid body[2];
  double history = 0.0;
  PairGroup group;

  TwoGrains(const GrainPair &pair) {
    for (int side = 0; side < 2; side++) {
      make(pair, side, body[side]);
      PackedGrain &grain = grains[side];
      const Spheroid &b = body[side];
      for (int k = 0; k < 3; k++) {
        grain.x[k] = side ? pair.d[k] : 0.0;
        grain.axis[k] = b.u[k];
      }
      grain.reach = *std::max_element(pair.semi[side], pair.semi[side] + 3);
      grain.inverse_product = b.inverse_product;
      shapes.push_back({b.equatorial_square, b.polar_square, b.inverse_equatorial_square, b.inverse_polar_square});
    }
    group.size = 1;
    for (int k = 0; k < LANES; k++) {
      group.i[k] = 0;
      group.j[k] = 1;
      group.history[k] = &history;
    }
  }
  PackedGrains packed() const { return {grains.data(), shapes.data(), false, nullptr, 2}; }
};

}

TEST(pair_group, spheres_touch_where_their_bounding_spheres_do) {
  Scene scene(1, Grains::spheres, 40, 40, 5.0);
  std::vector<double> history(16);
  int touching = 0;
  for (int n = 0; n < 2000; n++) {
    const PairGroup group = scene.group(1 + n % LANES, history);
    GroupGeometry g;
    meet_spheres(scene.packed(), group, g);
    for (int k = 0; k < group.size; k++) {
      expect_place(scene, group, g, k);
      ASSERT_EQ(g.touching[k], g.reachable[k]);
      ASSERT_EQ(bool(g.apart[k]), !g.touching[k]);
      touching += bool(g.touching[k]);
    }
    for (int k = group.size; k < LANES; k++) EXPECT_FALSE(g.reachable[k] || g.touching[k] || g.apart[k]);
  }
  EXPECT_GT(touching, 500);
  EXPECT_LT(touching, 4500);
}

TEST(pair_group, round_grains_meet_as_spheres) {
  Scene scene(2, Grains::round, 40, 40, 5.0);
  std::vector<double> history(16);
  SolverTally tally;
  int touching = 0, apart_in_reach = 0, in_reach = 0;
  for (int n = 0; n < 2000; n++) {
    const PairGroup group = scene.group(1 + n % LANES, history);
    GroupGeometry g;
    meet_round(scene.packed(), group, g, tally);
    expect_idle(group, g);
    for (int k = 0; k < group.size; k++) {
      double d[3];
      scene.place(group, k, d);
      expect_place(scene, group, g, k);
      if (!g.reachable[k]) {
        ASSERT_TRUE(g.apart[k] && !g.touching[k] && !g.alone[k]);
        continue;
      }
      const PackedGrain &one = scene.grains[group.i[k]], &two = scene.grains[group.j[k]];
      expect_contact(sphere_contact(one.axis[0], two.axis[0], d, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), g, k);
      ASSERT_EQ(g.met[k], g.touching[k]);
      ASSERT_FALSE(g.alone[k]);
      in_reach++;
      touching += bool(g.touching[k]);
      apart_in_reach += !g.touching[k];
    }
  }
  EXPECT_GT(touching, 500);
  EXPECT_GT(apart_in_reach, 50);
  EXPECT_EQ(sum(tally.solved), in_reach);
  EXPECT_EQ(sum(tally.touching), touching);
}

TEST(pair_group, grains_at_one_place_are_asked_of_the_single_solver) {
  for (Grains kind : {Grains::round, Grains::spheroids}) {
    Scene scene(3, kind, 3, 3, 5.0);
    std::vector<double> history(16);
    std::copy_n(scene.grains[0].x, 3, scene.grains[1].x);
    PairGroup group = scene.group(2, history);
    group.i[0] = 0;
    group.j[0] = 1;
    for (int k = 1; k < LANES; k++) {
      group.i[k] = 1;
      group.j[k] = 2;
    }
    GroupGeometry g;
    SolverTally tally;
    (kind == Grains::round ? meet_round : meet_spheroids)(scene.packed(), group, g, tally);
    EXPECT_TRUE(g.alone[0]);
    EXPECT_FALSE(g.alone[1]);
    EXPECT_LE(sum(tally.solved), 1);
    expect_idle(group, g);
  }
}

TEST(pair_group, spheroids_meet_as_they_do_alone) {
  for (bool one_shape : {false, true}) {
    Scene scene(4, Grains::spheroids, 40, 40, 6.0);
    if (one_shape) {
      scene.shapes.resize(1);
      for (std::size_t i = 1; i < scene.grains.size(); i++) {
        Spheroid alike = scene.bodies[0];
        std::copy_n(scene.bodies[i].u, 3, alike.u);
        scene.bodies[i] = alike;
        scene.grains[i].inverse_product = alike.inverse_product;
        scene.grains[i].reach = scene.grains[0].reach;
      }
    }
    std::vector<double> history(16);
    SolverTally tally;
    int touching = 0, apart_in_reach = 0, solved = 0, steps = 0, most_steps = 0, met = 0;
    for (int n = 0; n < 5000; n++) {
      for (double &h : history) h = scene.random.uniform() < 0.5 ? 0.0 : scene.random.uniform(-0.3, 0.3);
      const PairGroup group = scene.group(1 + n % LANES, history);
      GroupGeometry g;
      meet_spheroids(scene.packed(), group, g, tally);
      expect_idle(group, g);
      for (int k = 0; k < group.size; k++) {
        expect_place(scene, group, g, k);
        if (!g.reachable[k]) {
          ASSERT_TRUE(g.apart[k] && !g.touching[k] && !g.alone[k] && !g.met[k]);
          continue;
        }
        const double h = *group.history[k], start = h == 0.0 ? 0.0 : h + 0.5;
        double d[3];
        scene.place(group, k, d);
        const EllipsoidContact c = ellipsoid_contact(scene.bodies[group.i[k]], scene.bodies[group.j[k]], d, start);
        ASSERT_EQ(bool(g.alone[k]), c.steps > 6 || c.fallback);
        if (g.alone[k]) continue;
        expect_contact(c, g, k);
        ASSERT_EQ(bool(g.met[k]), c.touching && h == 0.0);
        solved++;
        touching += c.touching;
        apart_in_reach += !c.touching;
        met += bool(g.met[k]);
        steps += c.steps;
        most_steps = std::max(most_steps, c.steps);
      }
    }
    EXPECT_GT(touching, 500);
    EXPECT_GT(met, 100);
    EXPECT_GT(apart_in_reach, 100);
    EXPECT_EQ(sum(tally.solved), solved);
    EXPECT_EQ(sum(tally.touching), touching);
    EXPECT_EQ(tally.steps[0] + tally.steps[1] + tally.steps[2] + tally.steps[3], steps);
    EXPECT_EQ(std::max({tally.most_steps[0], tally.most_steps[1], tally.most_steps[2], tally.most_steps[3]}),
              most_steps);
  }
}

/** Aspect ratios of 0.05 to 20, sizes of 100 to 1, spheres; from touching by 1e-14 to far apart. The gap against a
 *  distance that is found by other means: no two points of the surfaces that face each other are nearer. */
TEST(pair_group, strangers_are_parted_only_if_they_are_apart) {
  RandomPairs random(5);
  int parted = 0, touching = 0;
  for (int n = 0; n < 20000; n++) {
    GrainPair pair;
    const double ratios[4] = {0.05, 20.0, 1.0, random.logarithmic(0.05, 20.0)};
    random.spheroid(pair, 0, ratios[n % 4]);
    random.spheroid(pair, 1, ratios[n / 4 % 4], n % 3 ? 1.0 : random.logarithmic(0.01, 100.0));
    random.place(pair, random.logarithmic(1e-14, 0.5) * (n % 5 < 2 ? 1.0 : -1.0));
    const TwoGrains two(pair);
    GroupGeometry g;
    part_spheroids(two.packed(), two.group, g);
    for (int k = 1; k < LANES; k++) ASSERT_FALSE(g.apart[k] || g.reachable[k]);
    const EllipsoidContact c = ellipsoid_contact(two.body[0], two.body[1], pair.d, 0.0);
    touching += c.touching;
    ASSERT_FALSE(c.touching && g.apart[0]);
    if (!g.apart[0]) continue;
    parted++;
    ASSERT_GT(g.gap[0], 0.0);
    if (n % 10) continue;
    const reference::Body one = pair.body(0), other = pair.body(1);
    const reference::Contact exact = reference::solve(one, other, pair.d);
    Quad direction[3] = {exact.normal[0], exact.normal[1], exact.normal[2]}, nearest = 0;
    for (int round = 0; round < 40; round++) {
      Quad from[3], to[3], between[3], back[3] = {-direction[0], -direction[1], -direction[2]};
      one.support(direction, from);
      other.support(back, to);
      for (int i = 0; i < 3; i++) between[i] = pair.d[i] + to[i] - from[i];
      const Quad square = reference::dot(between, between);
      if (round == 0 || square < nearest) nearest = square;
      reference::normalise(between);
      for (int i = 0; i < 3; i++) direction[i] += between[i] / (2 + round);
      reference::normalise(direction);
    }
    const double distance = static_cast<double>(reference::root(nearest));
    ASSERT_LE(g.gap[0], distance * (1.0 + 1e-12) + 1e-14 * pair.largest());
  }
  EXPECT_GT(touching, 5000);
  EXPECT_GT(parted, 2000);
}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "solid.h"
#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using grainscope::HalfSpace;
using grainscope::length_of;
using grainscope::Polyhedron;
using grainscope::Solid;

Solid block(const Vector3d &low, const Vector3d &high) {
  std::vector<HalfSpace> sides;
  for (int k = 0; k < 3; k++) {
    sides.push_back({-Vector3d::Unit(k), -low[k]});
    sides.push_back({Vector3d::Unit(k), high[k], true});
  }
  return Solid::flat(sides);
}

const Vector3d centre(0.3, -0.2, 0.1), axis = Vector3d(1.0, 2.0, -2.0) / 3.0;
const Solid ball = Solid::ball(centre, 1.1);
const Solid cylinder = Solid::round(centre, axis, -0.7, 1.2, 0.9, 0.9);
const Solid cone = Solid::round(centre, axis, -0.7, 1.2, 1.3, 0.2);
const Solid spike = Solid::round(centre, axis, -0.7, 1.2, 0.0, 1.5);
const Solid cuboid = block({-0.8, -0.9, -0.5}, {1.0, 0.7, 1.2});
const Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(0.6, 0.0, 0.8)).toRotationMatrix();

/** By the definitions of the bodies. */
bool in_ball(const Vector3d &x) { return (x - centre).norm() <= 1.1; }
bool in_round(const Vector3d &x, double lo, double hi, double radius_lo, double radius_hi) {
  const double s = axis.dot(x - centre), off = (x - centre - s * axis).norm();
  return s >= lo && s <= hi && off <= radius_lo + (s - lo) / (hi - lo) * (radius_hi - radius_lo);
}
bool in_cuboid(const Vector3d &x) {
  return x[0] >= -0.8 && x[0] <= 1.0 && x[1] >= -0.9 && x[1] <= 0.7 && x[2] >= -0.5 && x[2] <= 1.2;
}

struct Lines {
  std::mt19937 random{20};
  std::uniform_real_distribution<double> place{-2.0, 2.0};
  Vector3d point() { return {place(random), place(random), place(random)}; }
};

/** The share of a line by points on it: each end of its parts is off by one at most. */
template <class Inside>
void expect_shares(const Solid &solid, const Inside &inside) {
  const int points = 20000;
  Lines lines;
  double seen = 0.0;
  for (int k = 0; k < 60; k++) {
    const Vector3d from = lines.point(), to = lines.point();
    int counted = 0;
    for (int i = 0; i < points; i++) counted += inside(from + (i + 0.5) / points * (to - from));
    const double share = length_of(solid.parts(from, to));
    EXPECT_NEAR(share, static_cast<double>(counted) / points, 4.0 / points) << "line " << k;
    seen += share;
  }
  EXPECT_GT(seen, 1.0);
}

TEST(solid, shares_of_lines) {
  expect_shares(ball, in_ball);
  expect_shares(cylinder, [](const Vector3d &x) { return in_round(x, -0.7, 1.2, 0.9, 0.9); });
  expect_shares(cone, [](const Vector3d &x) { return in_round(x, -0.7, 1.2, 1.3, 0.2); });
  expect_shares(spike, [](const Vector3d &x) { return in_round(x, -0.7, 1.2, 0.0, 1.5); });
  expect_shares(cuboid, in_cuboid);
  expect_shares(cone.complement(), [](const Vector3d &x) { return !in_round(x, -0.7, 1.2, 1.3, 0.2); });
  expect_shares(Solid::united({ball, cuboid, cone}),
                [](const Vector3d &x) { return in_ball(x) || in_cuboid(x) || in_round(x, -0.7, 1.2, 1.3, 0.2); });
  expect_shares(Solid::common({ball, cuboid.complement()}),
                [](const Vector3d &x) { return in_ball(x) && !in_cuboid(x); });
}

TEST(solid, moved_is_asked_where_it_was) {
  const Vector3d shift(0.4, -0.3, 0.2);
  for (const Solid &solid : {ball, cylinder, cone, cuboid, Solid::united({ball, cuboid.complement()})}) {
    const Solid moved = solid.moved(turn, shift);
    Lines lines;
    for (int k = 0; k < 40; k++) {
      const Vector3d from = lines.point(), to = lines.point();
      EXPECT_NEAR(length_of(moved.parts(turn * from + shift, turn * to + shift)), length_of(solid.parts(from, to)),
                  1e-12);
    }
  }
}

TEST(solid, lines_along_an_axis_or_a_face) {
  EXPECT_DOUBLE_EQ(length_of(spike.parts(centre - 2.0 * axis, centre + 2.0 * axis)), 1.9 / 4.0);
  EXPECT_DOUBLE_EQ(length_of(cylinder.parts(centre - 2.0 * axis, centre + 2.0 * axis)), 1.9 / 4.0);
  const Vector3d across = axis.unitOrthogonal();
  // along the side of the cone a line is inside or outside by rounding; parallel to it and deeper it is inside
  const Vector3d low = centre - 0.7 * axis + 1.3 * across, high = centre + 1.2 * axis + 0.2 * across;
  const Vector3d deeper = -0.01 * across;
  EXPECT_NEAR(length_of(cone.parts(low + deeper, high + deeper)), 1.0, 1e-12);
  EXPECT_NEAR(length_of(cone.parts(low - deeper, high - deeper)), 0.0, 1e-12);
  // a face between two blocks belongs to the upper one
  const Solid lower = block({-1, -1, -1}, {1, 1, 0}), upper = block({-1, -1, 0}, {1, 1, 1});
  const Vector3d from(-0.5, 0.2, 0.0), to(0.5, 0.1, 0.0);
  EXPECT_EQ(length_of(lower.parts(from, to)), 0.0);
  EXPECT_EQ(length_of(upper.parts(from, to)), 1.0);
  EXPECT_EQ(length_of(ball.parts(centre, centre)), 1.0);
}

TEST(solid, partitions_add_up) {
  std::vector<Solid> all;
  const double cuts[] = {-1e20, -0.9, 0.0, 0.35, 1e20};
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4; j++)
      for (int k = 0; k < 4; k++)
        all.push_back(block({cuts[i], cuts[j], cuts[k]}, {cuts[i + 1], cuts[j + 1], cuts[k + 1]}));
  const std::vector<Solid> shells = {cone, Solid::common({ball, cone.complement()}),
                                     Solid::united({ball, cone}).complement()};
  Lines lines;
  for (int n = 0; n < 300; n++) {
    Vector3d from = lines.point(), to = lines.point();
    if (n % 3 == 0) from[n % 2] = to[n % 2] = cuts[1 + n % 3];  // in a face
    for (const auto &parts : {all, shells}) {
      double sum = 0.0;
      for (const Solid &one : parts) sum += length_of(one.parts(from, to));
      EXPECT_NEAR(sum, 1.0, 1e-12);
    }
  }
}

double volume_of(const Solid &solid, const Polyhedron &box) {
  double volume = -1.0;
  std::string why;
  EXPECT_TRUE(solid.volume_within(box, volume, why)) << why;
  return volume;
}

void expect_unknown(const Solid &solid, const Polyhedron &box) {
  double volume = -1.0;
  std::string why;
  EXPECT_FALSE(solid.volume_within(box, volume, why)) << volume;
  EXPECT_FALSE(why.empty());
}

Matrix3d tilted() {
  Matrix3d edges;
  edges << 5.0, 1.3, -0.7, 0.0, 4.0, 0.9, 0.0, 0.0, 6.0;
  return edges;
}

TEST(solid, volumes) {
  const Matrix3d upright = Vector3d(5.0, 4.0, 6.0).asDiagonal();
  const Polyhedron box(Vector3d(-2.5, -2.0, -3.0), upright);
  const double ball_volume = 4.0 / 3.0 * M_PI * 1.1 * 1.1 * 1.1;
  EXPECT_NEAR(volume_of(ball, box), ball_volume, 1e-12);
  EXPECT_NEAR(volume_of(ball.complement(), box), 120.0 - ball_volume, 1e-12);
  EXPECT_NEAR(volume_of(cylinder, box), M_PI * 0.81 * 1.9, 1e-12);
  EXPECT_NEAR(volume_of(cone, box), M_PI * 1.9 * (1.69 + 0.26 + 0.04) / 3.0, 1e-12);
  EXPECT_NEAR(volume_of(cuboid, box), 1.8 * 1.6 * 1.7, 1e-12);
  EXPECT_NEAR(volume_of(cuboid.moved(turn, {0.1, 0.2, 0.3}), box), 1.8 * 1.6 * 1.7, 1e-12);
  EXPECT_NEAR(volume_of(block({-1e20, -1e20, -1e20}, {1e20, 1e20, 1e20}), box), 120.0, 1e-12);
  EXPECT_NEAR(volume_of(block({-1e20, -1e20, -1.0}, {1e20, 1.0, 1e20}), box), 5.0 * 3.0 * 4.0, 1e-12);
  EXPECT_NEAR(volume_of(block({7, 7, 7}, {8, 8, 8}), box), 0.0, 1e-12);
  const Solid pipe = Solid::round({0, 0, 0}, Vector3d::UnitZ(), -1e20, 1e20, 1.5, 1.5);
  EXPECT_NEAR(volume_of(pipe, box), M_PI * 2.25 * 6.0, 1e-12);
  EXPECT_NEAR(volume_of(Solid::common({pipe, block({-9, -9, -9}, {9, 9, 1})}), box), M_PI * 2.25 * 4.0, 1e-12);
  const Solid cut = Solid::round({0, 0, 0}, Vector3d::UnitZ(), -2.0, 8.0, 2.0, 0.0);  // radius 1 at the face z = 3
  EXPECT_NEAR(volume_of(cut, box), M_PI * 5.0 * (4.0 + 2.0 + 1.0) / 3.0, 1e-12);
}

TEST(solid, volumes_that_are_not_known) {
  const Matrix3d upright = Vector3d(5.0, 4.0, 6.0).asDiagonal();
  const Polyhedron box(Vector3d(-2.5, -2.0, -3.0), upright);
  expect_unknown(Solid::ball({2.0, 0, 0}, 1.0), box);
  expect_unknown(Solid::round({0, 0, 0}, Vector3d::UnitZ(), -1, 1, 2.1, 2.1), box);
  expect_unknown(Solid::united({ball, cuboid}), box);
  expect_unknown(Solid::common({ball, cone}), box);
  expect_unknown(Solid::common({cuboid, ball.complement()}), box);
}

TEST(solid, volumes_in_a_tilted_box) {
  const Matrix3d edges = tilted();
  const Vector3d corner(-2.0, -2.2, -3.1);
  const Solid turned = block({-1.5, -3.0, -1.0}, {4.0, 2.5, 2.0}).moved(turn, Vector3d::Zero());
  const int n = 120;
  double counted = 0.0;
  Vector3d s;
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) {
      // lines along the third edge, whose share is exact
      s = Vector3d(i + 0.5, j + 0.5, 0.0) / n;
      const Vector3d from = corner + edges * s;
      counted += length_of(turned.parts(from, from + edges.col(2)));
    }
  const Polyhedron box(corner, edges);
  const double expected = 120.0 * counted / (n * n);
  EXPECT_NEAR(volume_of(turned, box), expected, 1e-3 * expected);  // the rule of midpoints, of a kinked integrand
  EXPECT_NEAR(volume_of(turned, box) + volume_of(turned.complement(), box), 120.0, 1e-11);
  // slabs of a partition
  double sum = 0.0;
  for (double z = -4.0; z < 4.0; z += 0.37)
    sum += volume_of(block({-1e20, -1e20, z}, {1e20, 1e20, z + 0.37}).moved(turn, Vector3d::Zero()), box);
  const Solid all = block({-1e20, -1e20, -4.0}, {1e20, 1e20, -4.0 + 22 * 0.37}).moved(turn, Vector3d::Zero());
  EXPECT_NEAR(sum, volume_of(all, box), 1e-11);
}

TEST(solid, sections_are_areas) {
  const Polyhedron layer(Vector3d(-2.5, -2.0, -0.5), Vector3d(5.0, 4.0, 1.0).asDiagonal());
  const auto area = [&layer](const Solid &solid) {
    Solid cut = solid;
    std::string why;
    EXPECT_TRUE(solid.section(0.0, cut, why)) << why;
    return volume_of(cut, layer);
  };
  EXPECT_NEAR(area(ball), M_PI * (1.21 - 0.01), 1e-12);
  EXPECT_NEAR(area(cuboid), 1.8 * 1.6, 1e-12);
  EXPECT_NEAR(area(block({-1, -1, 0.5}, {1, 1, 2})), 0.0, 1e-12);
  EXPECT_NEAR(area(Solid::ball({0, 0, 2}, 1.0)), 0.0, 1e-12);
  EXPECT_NEAR(area(Solid::round({0.1, 0.2, 1.0}, Vector3d::UnitZ(), -2.0, 2.0, 0.5, 1.5)), M_PI * 0.75 * 0.75, 1e-12);
  EXPECT_NEAR(area(Solid::common({cuboid, block({0, -9, -9}, {9, 9, 9})})), 1.0 * 1.6, 1e-12);
  // turned about x by 45 degrees a slab is wider
  const Matrix3d slanted = Eigen::AngleAxisd(M_PI_4, Vector3d::UnitX()).toRotationMatrix();
  EXPECT_NEAR(area(block({-1, -0.5, -9}, {1, 0.5, 9}).moved(slanted, Vector3d::Zero())), 2.0 * std::sqrt(2.0), 1e-12);
  Solid cut = cone;
  std::string why;
  EXPECT_FALSE(cone.section(0.0, cut, why));
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "nematic.h"
#include <gtest/gtest.h>
#include <cmath>

using Eigen::Vector3d;
using grainscope::Nematic;
using grainscope::NematicSums;
using grainscope::Shape;

namespace {

NematicSums axes(std::initializer_list<Vector3d> list, Shape shape = Shape::prolate) {
  NematicSums sums;
  for (const Vector3d &p : list) sums.add_axis(p.normalized(), shape);
  return sums;
}

}

TEST(nematic, two_of_four_along_z) {
  const Nematic n(axes({{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_NEAR(n.order, 0.25, 1e-15);  // 3/2 (1/2 - 1/3)
  EXPECT_NEAR(n.biaxiality, 0.0, 1e-15);
  EXPECT_NEAR(n.director[2], 1.0, 1e-15);
}

TEST(nematic, axes_in_a_plane_have_order_a_quarter_and_biaxiality_a_half) {
  const Nematic n(axes({{1, 0, 0}, {0, 1, 0}}));
  EXPECT_NEAR(n.order, 0.25, 1e-15);  // eigenvalues 1/6, 1/6, -1/3
  EXPECT_NEAR(n.biaxiality, 0.5, 1e-15);
}

TEST(nematic, q_has_no_trace) {
  const Nematic n(axes({{1, 2, 3}, {-1, 0.3, 0.2}, {0.1, 4, -2}}));
  EXPECT_NEAR(n.q.trace(), 0.0, 1e-15);
  EXPECT_TRUE(n.q.isApprox(n.q.transpose()));
  EXPECT_NEAR(n.eigenvalues.sum(), 0.0, 1e-15);
}

TEST(nematic, an_axis_and_its_opposite_are_the_same) {
  const Nematic one(axes({{1, 2, 3}})), other(axes({{-1, -2, -3}}));
  EXPECT_TRUE(one.q.isApprox(other.q));
  EXPECT_DOUBLE_EQ(one.theta, other.theta);
  EXPECT_TRUE(one.director.isApprox(other.director));
}

TEST(nematic, oblate_angle_is_that_of_the_major_axis) {
  const double a = 0.3;
  const Nematic n(axes({{-std::sin(a), std::cos(a), 0}}, Shape::oblate));
  EXPECT_NEAR(n.theta, a, 1e-15);
  EXPECT_NEAR(n.director_theta, a, 1e-15);
}

TEST(nematic, axes_along_z_have_no_angle) {
  const Nematic n(axes({{0, 0, 1}, {1e-10, 0, 1}}));
  EXPECT_EQ(n.grains_with_theta, 0.0);
  EXPECT_EQ(n.theta, 0.0);
}

TEST(nematic, empty_is_zero) {
  const Nematic n{NematicSums()};
  EXPECT_EQ(n.order, 0.0);
  EXPECT_TRUE(n.q.isZero(0.0) && n.director.isZero(0.0) && n.spin.isZero(0.0));
}

TEST(line_angle, is_in_the_half_open_interval) {
  EXPECT_NEAR(grainscope::line_angle(0, 1), M_PI_2, 1e-15);
  EXPECT_NEAR(grainscope::line_angle(0, -1), M_PI_2, 1e-15);
  EXPECT_NEAR(grainscope::line_angle(-1, 0), 0.0, 1e-15);
  EXPECT_NEAR(grainscope::line_angle(-1, -1), M_PI_4, 1e-15);
  EXPECT_NEAR(grainscope::line_angle(-1, 1), -M_PI_4, 1e-15);
}

TEST(nematic, a_line_across_is_at_plus_half_pi_whatever_its_rounding) {
  for (double off : {-1e-17, 0.0, 1e-17}) EXPECT_NEAR(Nematic(axes({{off, 1, 0}})).theta, M_PI_2, 1e-15);
}

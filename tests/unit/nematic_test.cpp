// SPDX-License-Identifier: GPL-2.0-or-later
#include "nematic.h"
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

using Eigen::Vector3d;
using grainscope::Nematic;
using grainscope::NematicSums;
using grainscope::Shape;

namespace {

NematicSums axes(std::initializer_list<Vector3d> list, Shape shape = Shape::prolate) {
  NematicSums sums;
  const double still[3] = {0.0, 0.0, 0.0};
  for (const Vector3d &p : list) {
    const auto turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), p);
    const double quaternion[4] = {turn.w(), turn.x(), turn.y(), turn.z()};
    sums.add_alike(1, {shape, 2}, quaternion, still);
  }
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

/** However many are shown at once, about each of the axes; by Eigen's rotation. */
TEST(nematic, grains_that_are_alike_are_summed_as_one_by_one) {
  for (int n : {1, 4, 11})
    for (int index = -1; index < 3; index++) {
      const grainscope::SymmetryAxis axis{index == 1 ? Shape::oblate : Shape::prolate, index};
      std::vector<double> quaternions, spins;
      NematicSums one_by_one(1, 2), at_once(1, 2);
      Eigen::Matrix3d pp = Eigen::Matrix3d::Zero();
      for (int i = 0; i < n; i++) {
        const Eigen::Quaterniond q =
            Eigen::Quaterniond(std::sin(i + 0.3), std::cos(2.0 * i), std::sin(3.0 * i + 1.0), 0.4).normalized();
        quaternions.insert(quaternions.end(), {q.w(), q.x(), q.y(), q.z()});
        spins.insert(spins.end(), {0.1 * i, -0.2, 0.3 + i});
        one_by_one.add_alike(1, axis, &quaternions[4 * i], &spins[3 * i]);
        if (index < 0) continue;
        const Vector3d p = q * Vector3d::Unit(index);
        pp += p * p.transpose();
      }
      at_once.add_alike(n, axis, quaternions.data(), spins.data());
      for (std::size_t k = 0; k < at_once.sums.size(); k++) EXPECT_NEAR(at_once.sums[k], one_by_one.sums[k], 1e-13);
      EXPECT_NEAR(at_once.sums[0], pp(0, 0), 1e-14);
      EXPECT_NEAR(at_once.sums[4], pp(0, 2), 1e-14);
      EXPECT_NEAR(at_once.sums[5], pp(1, 2), 1e-14);
    }
}

TEST(nematic, grains_are_alike_up_to_the_first_that_is_not) {
  for (int same = 1; same <= 9; same++) {
    std::vector<double> axes;
    for (int i = 0; i < 12; i++) axes.insert(axes.end(), {1.0, 1.0, i < same ? 2.0 : 2.5});
    EXPECT_EQ(NematicSums::alike(12, axes.data()), same);
    EXPECT_EQ(NematicSums::alike(same, axes.data()), same);
  }
}

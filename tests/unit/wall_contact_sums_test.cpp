// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_contact_sums.h"
#include "make_contact.h"
#include <gtest/gtest.h>

using Eigen::Vector3d;
using grainscope::Contact;
using grainscope::ContactRolling;
using grainscope::PartnerWall;
using grainscope::WallContactSums;
using S = WallContactSums;

namespace {

/** Force (10, 3, 0) on the grain at (-1, 0, 0), u_n = -0.5, u_t = (0, -2, 0); the wall moves by (2, 1, 5). */
Contact at_wall(int wall) {
  Contact c = make_contact();
  c.partner = PartnerWall{wall, 7, Vector3d(2.0, 1.0, 5.0)};
  return c;
}

WallContactSums two_rows(const Vector3d &about = Vector3d::Zero()) {
  WallContactSums sums(about);
  sums.set_rows({1, -1, 0}, 2);
  return sums;
}

}

TEST(wall_contact_sums, one_contact_by_hand) {
  WallContactSums sums = two_rows();
  sums.add(at_wall(0));
  const S::Row one = sums.of(1);
  EXPECT_DOUBLE_EQ(one[S::contacts], 1.0);
  EXPECT_DOUBLE_EQ(one[S::sliding], 1.0);
  EXPECT_DOUBLE_EQ(one[S::force], -10.0);
  EXPECT_DOUBLE_EQ(one[S::force + 1], -3.0);
  EXPECT_DOUBLE_EQ(one[S::force + 2], 0.0);
  EXPECT_DOUBLE_EQ(one[S::torque], 0.0);
  EXPECT_DOUBLE_EQ(one[S::torque + 2], 3.0);  // (-1, 0, 0) x (-10, -3, 0)
  EXPECT_DOUBLE_EQ(one[S::normal], 10.0);
  EXPECT_DOUBLE_EQ(one[S::shear], 3.0);
  EXPECT_DOUBLE_EQ(one[S::power], 23.0);
  EXPECT_DOUBLE_EQ(one[S::normal_damping], 2.0);
  EXPECT_DOUBLE_EQ(one[S::friction], 6.0);
  EXPECT_DOUBLE_EQ(one[S::tangential_damping], 0.0);
  EXPECT_DOUBLE_EQ(sums.of(0)[S::contacts], 0.0);
}

TEST(wall_contact_sums, torque_is_about_a_point_and_has_the_couple_of_rolling) {
  WallContactSums sums = two_rows(Vector3d(-1.0, -2.0, 0.0));
  Contact c = at_wall(2);
  c.rolling = ContactRolling{Vector3d::Zero(), Vector3d(0.5, 0.0, -4.0)};
  sums.add(c);
  const S::Row one = sums.of(0);  // (0, 2, 0) x (-10, -3, 0) = (0, 0, 20)
  EXPECT_DOUBLE_EQ(one[S::torque], -0.5);
  EXPECT_DOUBLE_EQ(one[S::torque + 1], 0.0);
  EXPECT_DOUBLE_EQ(one[S::torque + 2], 24.0);
}

TEST(wall_contact_sums, a_contact_that_sticks_loses_by_tangential_damping) {
  WallContactSums sums = two_rows();
  Contact c = at_wall(0);
  c.sliding = false;
  c.motion->damped = true;
  sums.add(c);
  const S::Row one = sums.of(1);
  EXPECT_DOUBLE_EQ(one[S::sliding], 0.0);
  EXPECT_DOUBLE_EQ(one[S::friction], 0.0);
  EXPECT_DOUBLE_EQ(one[S::tangential_damping], 20.0);  // 5 x 2^2
}

TEST(wall_contact_sums, walls_without_a_row_are_left_out_and_reset_forgets) {
  WallContactSums sums = two_rows();
  sums.add(at_wall(1));
  for (double number : sums.numbers()) EXPECT_EQ(number, 0.0);
  sums.add(at_wall(0));
  sums.add(at_wall(0));
  EXPECT_DOUBLE_EQ(sums.of(1)[S::contacts], 2.0);
  sums.reset();
  EXPECT_EQ(sums.rows(), 2);
  for (double number : sums.numbers()) EXPECT_EQ(number, 0.0);
}

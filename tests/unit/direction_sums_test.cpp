// SPDX-License-Identifier: GPL-2.0-or-later
#include "direction_sums.h"
#include "make_contact.h"
#include <gtest/gtest.h>
#include <limits>

using Eigen::Vector3d;
using grainscope::Contact;
using grainscope::DirectionSums;

TEST(direction_sums, one_contact_by_hand) {
  DirectionSums sums(0, 1, 4);
  Contact c = make_contact();  // along x: the first bin; F_n 10, F_t (0, 3, 0) along (-sin 0, cos 0)
  sums.add(c);
  EXPECT_DOUBLE_EQ(sums.bin(0).contacts, 1.0);
  EXPECT_DOUBLE_EQ(sums.bin(0).normal, 10.0);
  EXPECT_DOUBLE_EQ(sums.bin(0).tangential, 3.0);
  EXPECT_DOUBLE_EQ(sums.bin(0).along, 3.0);
  c.normal = -c.normal;  // as the other grain sees it: beta + pi is the same line
  c.tangential_force = -c.tangential_force;
  sums.add(c);
  EXPECT_DOUBLE_EQ(sums.bin(0).contacts, 2.0);
  EXPECT_DOUBLE_EQ(sums.bin(0).along, 6.0);
  EXPECT_DOUBLE_EQ(sums.contacts(), 2.0);
}

TEST(direction_sums, only_the_projection_on_the_plane_counts) {
  DirectionSums sums(0, 1, 4);
  Contact c = make_contact();
  c.normal = Vector3d(0.6, 0.0, 0.8);
  sums.add(c);
  EXPECT_DOUBLE_EQ(sums.bin(0).normal, 6.0);
  c.normal = Vector3d::UnitZ();  // has no direction in the plane
  sums.add(c);
  EXPECT_DOUBLE_EQ(sums.contacts(), 1.0);
}

TEST(direction_sums, a_direction_that_is_not_finite_is_in_no_bin) {
  DirectionSums sums(0, 1, 4);
  Contact c = make_contact();
  c.normal[1] = std::numeric_limits<double>::quiet_NaN();
  sums.add(c);
  EXPECT_DOUBLE_EQ(sums.contacts(), 0.0);
  EXPECT_DOUBLE_EQ(sums.not_finite(), 1.0);
  sums.reset();
  EXPECT_DOUBLE_EQ(sums.not_finite(), 0.0);
}

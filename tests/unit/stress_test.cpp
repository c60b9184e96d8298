// SPDX-License-Identifier: GPL-2.0-or-later
#include "make_contact.h"
#include "stress.h"
#include <gtest/gtest.h>

using grainscope::StressSums;

TEST(stress, one_contact_by_hand) {
  StressSums sums;
  sums.add(make_contact());
  const Eigen::Matrix3d total = sums.total(4.0);
  EXPECT_DOUBLE_EQ(total(0, 0), -5.0);  // -F_x r_x / V = -10 x 2 / 4: compression is negative
  EXPECT_DOUBLE_EQ(total(1, 0), -1.5);  // F_y r_x
  EXPECT_DOUBLE_EQ(total(0, 1), 0.0);   // F_x r_y
  EXPECT_DOUBLE_EQ(sums.tangential(4.0)(1, 0), -1.5);
  EXPECT_DOUBLE_EQ(sums.tangential(4.0)(0, 0), 0.0);
}

TEST(stress, two_owners_of_a_contact_count_it_once) {
  StressSums once, twice;
  once.add(make_contact());
  grainscope::Contact other = make_contact(0.5);
  twice.add(other);
  other.branch = -other.branch;
  other.force = -other.force;
  other.tangential_force = -other.tangential_force;
  twice.add(other);
  EXPECT_TRUE(twice.total(1.0).isApprox(once.total(1.0)));
  EXPECT_DOUBLE_EQ(twice.contacts(), 1.0);
  EXPECT_DOUBLE_EQ(twice.sliding(), 1.0);
  EXPECT_DOUBLE_EQ(twice.overlaps(), 0.01);
  EXPECT_DOUBLE_EQ(twice.largest_overlap, 0.01);
}

TEST(stress, contacts_with_walls_are_counted_apart_and_summed_together) {
  StressSums sums;
  sums.add(make_contact());
  grainscope::Contact wall = make_contact();
  wall.partner = grainscope::PartnerWall();
  wall.branch = Eigen::Vector3d(1.0, 0.0, 0.0);  // to the contact point, half as far
  wall.overlap = 0.03;
  wall.sliding = false;
  sums.add(wall);
  EXPECT_DOUBLE_EQ(sums.contacts_of_grains(), 1.0);
  EXPECT_DOUBLE_EQ(sums.contacts_with_walls(), 1.0);
  EXPECT_DOUBLE_EQ(sums.contacts(), 2.0);
  EXPECT_DOUBLE_EQ(sums.sliding(), 1.0);
  EXPECT_DOUBLE_EQ(sums.overlaps(), 0.04);
  EXPECT_DOUBLE_EQ(sums.total(4.0)(0, 0), -7.5);  // -(10 x 2 + 10 x 1)/4
}

TEST(stress, empty_is_zero) { EXPECT_TRUE(StressSums().total(1.0).isZero(0.0)); }

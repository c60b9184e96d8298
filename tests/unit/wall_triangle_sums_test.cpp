// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_triangle_sums.h"
#include "make_contact.h"
#include <gtest/gtest.h>

using grainscope::Contact;
using grainscope::PartnerWall;
using grainscope::WallTriangleSums;
using S = WallTriangleSums;

namespace {

/** Slides: F_n = 10, F_t = 3, |u_t| = 2. */
Contact at_triangle(int wall, int triangle) {
  Contact c = make_contact();
  c.partner = PartnerWall{wall, triangle, Eigen::Vector3d::Zero()};
  return c;
}

WallTriangleSums two_meshes() {
  WallTriangleSums sums;
  sums.set_meshes({-1, 1, 0}, {2, 3});
  return sums;
}

}

TEST(wall_triangle_sums, one_contact_by_hand) {
  WallTriangleSums sums = two_meshes();
  sums.add(at_triangle(1, 2));
  EXPECT_EQ(sums.triangles(), 5u);
  EXPECT_EQ(sums.place(1, 2), 4u);
  const double *at = sums.at(4);
  EXPECT_DOUBLE_EQ(at[S::contacts], 1.0);
  EXPECT_DOUBLE_EQ(at[S::normal], 10.0);
  EXPECT_DOUBLE_EQ(at[S::friction], 6.0);
  EXPECT_DOUBLE_EQ(at[S::archard], 20.0);
  sums.reset();
  EXPECT_EQ(sums.at(4)[S::normal], 0.0);
}

TEST(wall_triangle_sums, what_sticks_or_pulls_wears_nothing) {
  WallTriangleSums sums = two_meshes();
  Contact c = at_triangle(2, 0);
  c.sliding = false;
  sums.add(c);
  c.sliding = true;
  c.normal_force = -10.0;
  sums.add(c);
  EXPECT_DOUBLE_EQ(sums.at(0)[S::contacts], 2.0);
  EXPECT_DOUBLE_EQ(sums.at(0)[S::normal], 0.0);
  EXPECT_DOUBLE_EQ(sums.at(0)[S::archard], 0.0);
}

TEST(wall_triangle_sums, other_walls_are_left_out) {
  WallTriangleSums sums = two_meshes();
  sums.add(at_triangle(0, -1));
  for (double number : sums.numbers()) EXPECT_EQ(number, 0.0);
}

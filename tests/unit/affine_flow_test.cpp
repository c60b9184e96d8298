// SPDX-License-Identifier: GPL-2.0-or-later
#include "affine_flow.h"
#include <gtest/gtest.h>

using Eigen::Vector3d;
using grainscope::AffineFlow;

TEST(affine_flow, box_that_does_not_deform_has_none) {
  EXPECT_EQ(AffineFlow().flow(Vector3d(1.0, 2.0, 3.0)), Vector3d::Zero());
}

/** Simple shear: v_x = rate (y - y_c). */
TEST(affine_flow, shear_about_the_centre) {
  AffineFlow shear;
  shear.velocity_gradient(0, 1) = 0.5;
  shear.centre = Vector3d(1.0, 2.0, 3.0);
  EXPECT_EQ(shear.flow(Vector3d(7.0, 4.0, 9.0)), Vector3d(1.0, 0.0, 0.0));
  EXPECT_EQ(shear.flow(shear.centre), Vector3d::Zero());
}

TEST(affine_flow, all_six_components) {
  AffineFlow flow;
  flow.velocity_gradient << 1.0, 2.0, 3.0, 0.0, 4.0, 5.0, 0.0, 0.0, 6.0;
  EXPECT_EQ(flow.gradient_times(Vector3d(1.0, 10.0, 100.0)), Vector3d(321.0, 540.0, 600.0));
  EXPECT_EQ(flow.gradient_times(Vector3d(1.0, 10.0, 100.0)), flow.velocity_gradient * Vector3d(1.0, 10.0, 100.0));
}

/** A centre that moves along what the flow leaves at rest makes no other flow. */
TEST(affine_flow, equal_where_velocities_are) {
  AffineFlow one;
  one.velocity_gradient(0, 1) = 0.5;
  AffineFlow other = one;
  other.centre = Vector3d(3.0, 0.0, -2.0);
  EXPECT_TRUE(one == other);
  other.centre[1] = 1.0;
  EXPECT_FALSE(one == other);
  other = one;
  other.velocity_gradient(0, 1) = 0.25;
  EXPECT_FALSE(one == other);
}

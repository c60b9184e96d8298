// SPDX-License-Identifier: GPL-2.0-or-later
#include "symmetric_tensor.h"
#include <gtest/gtest.h>

using Eigen::Matrix3d;
using Eigen::Vector3d;
using grainscope::SixComponents;

TEST(symmetric_tensor, dyad_is_xx_yy_zz_xy_xz_yz) {
  const Vector3d a(2.0, 3.0, 5.0);
  EXPECT_EQ(grainscope::dyad(a, a), (SixComponents{{4.0, 9.0, 25.0, 6.0, 10.0, 15.0}}));
  const double twice[3] = {4.0, 6.0, 10.0};
  EXPECT_EQ(grainscope::dyad(twice, a), (SixComponents{{8.0, 18.0, 50.0, 12.0, 20.0, 30.0}}));
}

TEST(symmetric_tensor, sums_take_their_weights) {
  double sums[7] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  grainscope::add_components(sums, {{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}});
  grainscope::add_components(sums, 0.5, {{2.0, 4.0, 6.0, 8.0, 10.0, 12.0}});
  for (int k = 0; k < 6; k++) EXPECT_EQ(sums[k], 3.0 + 2.0 * k) << k;
  EXPECT_EQ(sums[6], 1.0);
}

/** To the last bit what was written by hand before: weight times each product, added one after the other. */
TEST(symmetric_tensor, weights_multiply_products) {
  const Vector3d n = Vector3d(0.3, -0.7, 0.11).normalized();
  const double weight = 1.0 / 3.0;
  double sums[6] = {};
  grainscope::add_components(sums, weight, grainscope::dyad(n, n));
  const int rows[6] = {0, 1, 2, 0, 0, 1}, columns[6] = {0, 1, 2, 1, 2, 2};
  for (int k = 0; k < 6; k++) EXPECT_EQ(sums[k], weight * (n[rows[k]] * n[columns[k]])) << k;
}

TEST(symmetric_tensor, six_numbers_and_back) {
  const double six[6] = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  Matrix3d expected;
  expected << 1.0, 4.0, 5.0, 4.0, 2.0, 6.0, 5.0, 6.0, 3.0;
  EXPECT_EQ(grainscope::symmetric_tensor(six), expected);
  double written[7] = {};
  EXPECT_EQ(grainscope::write_components(expected, written), written + 6);
  for (int k = 0; k < 6; k++) EXPECT_EQ(written[k], six[k]) << k;
  EXPECT_EQ(written[6], 0.0);
}

/** A stress need not be symmetric: outputs show xy, not yx. */
TEST(symmetric_tensor, components_are_of_the_upper_triangle) {
  Matrix3d m;
  m << 1.0, 4.0, 5.0, -4.0, 2.0, 6.0, -5.0, -6.0, 3.0;
  double written[6];
  grainscope::write_components(m, written);
  for (int k = 0; k < 6; k++) EXPECT_EQ(written[k], k + 1.0) << k;
}

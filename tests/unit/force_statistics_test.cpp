// SPDX-License-Identifier: GPL-2.0-or-later
#include "force_statistics.h"
#include "make_contact.h"
#include <gtest/gtest.h>
#include <limits>

using grainscope::ContactForce;
using grainscope::ForceDistribution;
using grainscope::ForceMoments;

namespace {

ContactForce of(double normal) {
  ContactForce c;
  c.normal = normal;
  c.force = Eigen::Vector3d(normal, 0.0, 0.0);
  c.branch = Eigen::Vector3d(2.0, 0.0, 0.0);
  return c;
}

ForceDistribution distribution(const std::vector<double> &forces, double mean, double tail = 1.0) {
  ForceDistribution p(4, 4.0, tail);
  for (double f : forces) p.add(of(f), mean);
  return p;
}

}

TEST(force_statistics, moments_by_hand) {
  ForceMoments m;
  m.add(ContactForce(make_contact(), Eigen::Vector3d::Zero()));  // 10, and 3
  ContactForce wall = of(4.0);
  wall.with_wall = true;
  m.add(wall);
  EXPECT_EQ(m.of_grains(), 1.0);
  EXPECT_EQ(m.with_walls(), 1.0);
  EXPECT_DOUBLE_EQ(m.mean_normal(), 7.0);
  EXPECT_DOUBLE_EQ(m.normal_squared(), 116.0);
  EXPECT_DOUBLE_EQ(m.tangential(), 3.0);
  EXPECT_DOUBLE_EQ(m.largest_normal, 10.0);
  EXPECT_DOUBLE_EQ(m.largest_tangential, 3.0);
  m.add(of(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(m.not_finite(), 1.0);
  m.reset();
  EXPECT_EQ(m.mean_normal(), 0.0);
}

TEST(force_statistics, bins_and_what_is_outside) {
  const ForceDistribution p = distribution({1.0, 3.0, 3.9, 9.0, -1.0}, 2.0);
  EXPECT_EQ(p.in_bin(0), 1.0);
  EXPECT_EQ(p.in_bin(1), 2.0);
  EXPECT_EQ(p.in_bin(2) + p.in_bin(3), 0.0);  // 4.5 is beyond
  EXPECT_EQ(p.negative(), 1.0);
  EXPECT_EQ(p.strong(), 3.0);
  EXPECT_EQ(p.width(), 1.0);
}

/** Quantiles of an exponential and of a power law give back their exponents; the errors are those of Fisher. */
TEST(force_statistics, exponents_of_largest_likelihood) {
  const int n = 100000;
  const double beta = 1.7, alpha = 0.3;
  ForceDistribution p(4, 4.0, 1.5);
  for (int k = 0; k < n; k++) {
    const double u = (k + 0.5) / n;
    p.add(of(1.5 - std::log(u) / beta), 1.0);
    p.add(of(std::pow(u, 1.0 / (1.0 - alpha))), 1.0);
  }
  EXPECT_NEAR(p.tail_exponent(), beta, 1e-4);
  EXPECT_NEAR(p.weak_exponent(), alpha, 1e-4);
  EXPECT_NEAR(p.tail_error(), beta / std::sqrt(n), 1e-6);
  EXPECT_NEAR(p.weak_error(), (1.0 - alpha) / std::sqrt(n), 1e-6);
}

TEST(force_statistics, shares_of_strong_contacts) {
  ForceDistribution p(4, 4.0, 1.0);
  ContactForce across = of(1.0);
  across.force = Eigen::Vector3d(0.0, 1.0, 0.0);
  across.branch = Eigen::Vector3d(0.0, 2.0, 0.0);
  p.add(of(3.0), 2.0);
  p.add(across, 2.0);
  EXPECT_DOUBLE_EQ(p.strong_pressure(), 0.75);
  // in the plane: all diag(2, -2), strong diag(3, -3)
  EXPECT_DOUBLE_EQ(p.strong_deviator(2), 1.5);
}

TEST(force_statistics, forces_that_pull_have_no_distribution) {
  const ForceDistribution p = distribution({-1.0, -3.0}, -2.0);
  EXPECT_EQ(p.strong(), 1.0);
  EXPECT_EQ(p.tail() + p.weak() + p.in_bin(0), 0.0);
  EXPECT_EQ(p.tail_exponent(), 0.0);
  EXPECT_EQ(p.tail_error(), 0.0);
  EXPECT_EQ(p.weak_exponent(), 0.0);
  EXPECT_EQ(p.weak_error(), 0.0);
}

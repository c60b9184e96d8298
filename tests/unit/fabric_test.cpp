// SPDX-License-Identifier: GPL-2.0-or-later
#include "fabric.h"
#include "make_contact.h"
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

using namespace grainscope;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

Contact along(const Vector3d &normal, double weight = 1.0) {
  Contact c;
  c.normal = normal;
  c.weight = weight;
  return c;
}

}

TEST(fabric, has_trace_one_and_counts_weights) {
  FabricSums sums;
  sums.add(along(Vector3d::UnitX()));
  sums.add(along(Vector3d(0.6, 0.8, 0.0), 0.5));
  sums.add(along(Vector3d(-0.6, -0.8, 0.0), 0.5));
  EXPECT_DOUBLE_EQ(sums.contacts(), 2.0);
  EXPECT_NEAR(sums.tensor().trace(), 1.0, 1e-15);
  EXPECT_NEAR(sums.tensor()(0, 0), 0.5 * (1.0 + 0.36), 1e-15);
  EXPECT_NEAR(sums.tensor()(0, 1), 0.5 * 0.48, 1e-15);
}

TEST(fabric, is_zero_without_contacts) { EXPECT_EQ(FabricSums().tensor(), Matrix3d::Zero()); }

TEST(weighted_fabric, of_an_isotropic_network_tells_where_forces_are) {
  // Contacts along x, y, z: a_c = 0 and all weights 1/3. The branch along x is 2, others 1: D = diag(2, 1, 1)/3.
  WeightedFabricSums sums;
  const Matrix3d isotropic = Matrix3d::Identity() / 3.0;
  for (int k = 0; k < 3; k++)
    sums.add({Vector3d::Unit(k), 1.0, k == 0 ? 2.0 : 1.0, 3.0, k == 2 ? 1.0 : 0.0}, isotropic);
  EXPECT_NEAR(sums.branch()(0, 0), 7.5 * (2.0 / 4.0 - 1.0 / 3.0), 1e-15);
  EXPECT_NEAR(sums.branch().trace(), 0.0, 1e-15);
  EXPECT_NEAR(sums.normal_force().norm(), 0.0, 1e-15);
  EXPECT_NEAR(sums.tangential_force()(2, 2), 5.0 / 9.0 * (1.0 - 1.0 / 3.0), 1e-15);
}

TEST(weighted_fabric, weighs_by_the_contact_anisotropy) {
  // Two contacts along x, one along y: F = diag(2, 1, 0)/3, a_c = diag(2.5, 0, -2.5), weights 1/3.5 and 1.
  Matrix3d fabric = Vector3d(2.0 / 3.0, 1.0 / 3.0, 0.0).asDiagonal();
  WeightedFabricSums sums;
  for (int k : {0, 0, 1}) sums.add({Vector3d::Unit(k), 1.0, 1.0, 1.0, 0.0}, fabric);
  const double x = 2.0 / 3.5, y = 1.0;
  EXPECT_NEAR(sums.branch()(0, 0), 7.5 * (x / (x + y) - 1.0 / 3.0), 1e-14);
  EXPECT_NEAR(sums.branch()(2, 2), -2.5, 1e-14);
}

TEST(weighted_fabric, is_zero_without_forces) {
  WeightedFabricSums sums;
  sums.add({Vector3d::UnitX(), 1.0, 1.0, 0.0, 0.0}, Matrix3d::Identity() / 3.0);
  EXPECT_EQ(sums.normal_force(), Matrix3d::Zero());
  EXPECT_EQ(sums.tangential_force(), Matrix3d::Zero());
}

TEST(fabric, deviator_is_one_for_one_direction_and_zero_for_none) {
  const Matrix3d one = Vector3d(1.0, 0.0, 0.0).asDiagonal(), none = Vector3d(0.5, 0.5, 0.0).asDiagonal();
  EXPECT_NEAR(fabric_deviator(one, 2), 1.0, 1e-15);
  EXPECT_NEAR(fabric_deviator(one, 3), 1.0, 1e-15);
  EXPECT_NEAR(fabric_deviator(none, 2), 0.0, 1e-15);
  EXPECT_NEAR(fabric_deviator(Matrix3d::Identity() / 3.0, 3), 0.0, 1e-15);
}

TEST(weighted_fabric, of_two_dimensions_gives_back_what_a_ring_of_contacts_was_made_with) {
  // 7 contacts around the circle, which means of four n need at least: the density is 1 + a:nn, as weights, forces are
  // f_0 (1 + b:nn) and f_0 c:nn with c traceless, which T alone feels.
  Matrix3d a = Matrix3d::Zero(), b = a, c = a;
  a.topLeftCorner<2, 2>() << 0.3, 0.1, 0.1, -0.3;
  b.topLeftCorner<2, 2>() << -0.2, 0.25, 0.25, 0.2;
  c.topLeftCorner<2, 2>() << 0.15, -0.05, -0.05, -0.15;
  const int ring = 7;
  FabricSums fabric;
  std::vector<ContactMoment> contacts;
  for (int k = 0; k < ring; k++) {
    const double angle = 2.0 * M_PI * k / ring;
    const Vector3d n(std::cos(angle), std::sin(angle), 0.0);
    const double density = 1.0 + n.dot(a * n);
    fabric.add(along(n, density));
    contacts.push_back({n, density, 2.0 * (1.0 + n.dot(b * n)), 3.0 * (1.0 + n.dot(b * n)), 3.0 * n.dot(c * n)});
  }
  WeightedFabricSums sums(2);
  for (const ContactMoment &one : contacts) sums.add(one, fabric.tensor());
  EXPECT_NEAR((sums.branch() - b).norm(), 0.0, 1e-14);
  EXPECT_NEAR((sums.normal_force() - b).norm(), 0.0, 1e-14);
  // |F_t| n n as they stand: T = f_0 c/4, over tr N = f_0
  EXPECT_NEAR((sums.tangential_force() - c).norm(), 0.0, 1e-14);
}

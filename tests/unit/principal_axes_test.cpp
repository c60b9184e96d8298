// SPDX-License-Identifier: GPL-2.0-or-later
#include "principal_axes.h"
#include <Eigen/Geometry>
#include <gtest/gtest.h>

using namespace grainscope;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

Matrix3d turned(const Vector3d &values, const Matrix3d &r) { return r * values.asDiagonal() * r.transpose(); }

const Matrix3d rotation =
    (Eigen::AngleAxisd(0.7, Vector3d::UnitZ()) * Eigen::AngleAxisd(1.1, Vector3d::UnitX())).toRotationMatrix();

}

TEST(principal_axes, descend_with_the_largest_component_positive) {
  const PrincipalAxes axes(turned({0.2, 0.5, 0.3}, rotation));
  EXPECT_NEAR((axes.values - Vector3d(0.5, 0.3, 0.2)).norm(), 0.0, 1e-14);
  const int order[3] = {1, 2, 0};
  for (int k = 0; k < 3; k++) {
    EXPECT_NEAR(std::fabs(axes.vectors.col(k).dot(rotation.col(order[k]))), 1.0, 1e-14);
    EXPECT_GT(axes.vectors.col(k).maxCoeff(), -axes.vectors.col(k).minCoeff());
  }
}

TEST(principal_axes, of_an_isotropic_tensor_are_those_of_the_laboratory) {
  const Matrix3d noise = 1e-13 * (Matrix3d() << 1, 2, -1, 2, 0, 3, -1, 3, -2).finished();
  const PrincipalAxes axes(Matrix3d(Matrix3d::Identity() / 3.0 + noise));
  EXPECT_EQ(axes.vectors, Matrix3d::Identity());
}

TEST(principal_axes, of_a_degenerate_plane_do_not_follow_rounding) {
  for (double noise : {0.0, 1e-14, -1e-14}) {
    Matrix3d tensor = Vector3d(0.25, 0.25, 0.5).asDiagonal();
    tensor(0, 1) = tensor(1, 0) = noise;
    const PrincipalAxes axes(tensor);
    EXPECT_NEAR((axes.vectors.col(0) - Vector3d::UnitZ()).norm(), 0.0, 1e-12);
    EXPECT_NEAR((axes.vectors.col(1) - Vector3d::UnitX()).norm(), 0.0, 1e-12);
    EXPECT_NEAR((axes.vectors.col(2) - Vector3d::UnitY()).norm(), 0.0, 1e-12);
  }
}

TEST(principal_axes, of_a_degenerate_plane_that_is_tilted) {
  const PrincipalAxes axes(turned({0.4, 0.4, 0.2}, rotation));
  EXPECT_NEAR((axes.vectors.transpose() * axes.vectors - Matrix3d::Identity()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(std::fabs(axes.vectors.col(2).dot(rotation.col(2))), 1.0, 1e-12);
}

TEST(principal_axes, of_zero_are_those_of_the_laboratory) {
  const PrincipalAxes axes{Matrix3d(Matrix3d::Zero())};
  EXPECT_EQ(axes.vectors, Matrix3d::Identity());
  EXPECT_EQ(axes.values, Vector3d::Zero());
}

TEST(principal_axes, of_two_dimensions_are_in_the_plane_first) {
  const Vector3d n(0.6, -0.8, 0.0);
  const PrincipalAxes one(n * n.transpose(), 2);
  EXPECT_NEAR((one.values - Vector3d(1.0, 0.0, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((one.vectors.col(0) - Vector3d(-0.6, 0.8, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((one.vectors.col(1) - Vector3d(0.8, 0.6, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_EQ(one.vectors.col(2), Vector3d(Vector3d::UnitZ()));
  const Matrix3d isotropic = Vector3d(0.5, 0.5, 0.0).asDiagonal();
  EXPECT_EQ(PrincipalAxes(isotropic, 2).vectors, Matrix3d(Matrix3d::Identity()));
}

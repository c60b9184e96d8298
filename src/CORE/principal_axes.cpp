// SPDX-License-Identifier: GPL-2.0-or-later
#include "principal_axes.h"
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

namespace grainscope {

using Eigen::Vector3d;

namespace {

/** Index of the largest component; the first of those that are equal but for rounding. */
int largest_component(const Vector3d &v) {
  int largest = 0;
  for (int k = 1; k < 3; k++)
    if (std::fabs(v[k]) > std::fabs(v[largest]) + 1e-10) largest = k;
  return largest;
}

Vector3d with_sign(const Vector3d &v) { return v[largest_component(v)] < 0.0 ? Vector3d(-v) : v; }

/** The direction in the plane across `pole` nearest to the laboratory axis that lies most in it. */
Vector3d nearest_axis_across(const Vector3d &pole) {
  int axis = 0;
  for (int k = 1; k < 3; k++)
    if (std::fabs(pole[k]) < std::fabs(pole[axis]) - 1e-10) axis = k;
  const Vector3d e = Vector3d::Unit(axis);
  return (e - e.dot(pole) * pole).normalized();
}

}

PrincipalAxes::PrincipalAxes(const Eigen::Matrix3d &tensor, int dimension) {
  if (dimension == 2) solve_in_plane(tensor);
  else solve(tensor);
  for (int k = 0; k < 3; k++) vectors.col(k) = with_sign(vectors.col(k));
}

void PrincipalAxes::solve_in_plane(const Eigen::Matrix3d &tensor) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(tensor.topLeftCorner<2, 2>());
  values << solver.eigenvalues().reverse(), tensor(2, 2);
  vectors.setIdentity();
  if (values[0] - values[1] > 1e-10 * values.cwiseAbs().maxCoeff())
    vectors.topLeftCorner<2, 2>() = solver.eigenvectors().rowwise().reverse();
}

void PrincipalAxes::solve(const Eigen::Matrix3d &tensor) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(tensor);
  values = solver.eigenvalues().reverse();
  vectors = solver.eigenvectors().rowwise().reverse();
  const double close = 1e-10 * values.cwiseAbs().maxCoeff();
  const bool first_two = values[0] - values[1] <= close, last_two = values[1] - values[2] <= close;
  if (first_two && last_two) {
    vectors.setIdentity();
  } else if (first_two || last_two) {
    const int pole = first_two ? 2 : 0, one = first_two ? 0 : 1;
    vectors.col(one) = nearest_axis_across(vectors.col(pole));
    vectors.col(one + 1) = vectors.col(pole).cross(vectors.col(one));
  }
}

}

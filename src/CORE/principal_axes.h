// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PRINCIPAL_AXES_H
#define GRAINSCOPE_PRINCIPAL_AXES_H

#include <Eigen/Core>

namespace grainscope {

/** Eigenvalues (descending) and eigenvectors (columns, unit, the largest component of each positive) of a symmetric
 *  tensor. Eigenvalues closer than 1e-10 of the largest magnitude are equal; their eigenvectors are then chosen by a
 *  rule, so that rounding does not turn them: in a degenerate plane the first is nearest to the laboratory axis that
 *  lies most in that plane, and an isotropic tensor has x, y, z. With `dimension` 2 the first two are in the plane x,
 *  y, where the tensor has its components, and the third is z. */
struct PrincipalAxes {
  explicit PrincipalAxes(const Eigen::Matrix3d &tensor, int dimension = 3);

  Eigen::Vector3d values;
  Eigen::Matrix3d vectors;

 private:
  void solve(const Eigen::Matrix3d &tensor);
  void solve_in_plane(const Eigen::Matrix3d &tensor);
};

}

#endif

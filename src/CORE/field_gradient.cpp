// SPDX-License-Identifier: GPL-2.0-or-later
#include "field_gradient.h"
#include <Eigen/Eigenvalues>

namespace grainscope {

using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

const double rounding = 1e-9;  // of sums of squares: places that differ by less than 3e-5 of the others are the same

}

FieldMotion::FieldMotion(const FieldMap &map, const FieldSums &sums, const std::array<bool, 3> &wraps,
                         const Matrix3d &jumps)
    : means_(sums.cells()) {
  for (int cell = 0; cell < sums.cells(); cell++) {
    Mean &mean = means_[cell];
    mean.mass = *sums.of(FieldSums::mass, cell);
    if (!(mean.mass > 0.0)) continue;
    mean.velocity = Map<const Vector3d>(sums.of(FieldSums::momentum, cell)) / mean.mass;
    mean.centre = map.cells().middle(cell) + Map<const Vector3d>(sums.of(FieldSums::centroid, cell)) / mean.mass;
  }
  for (int cell = 0; cell < sums.cells(); cell++)
    if (means_[cell].mass > 0.0) means_[cell].gradient = fitted(map, cell, wraps, jumps);
}

Matrix3d FieldMotion::fitted(const FieldMap &map, int cell, const std::array<bool, 3> &wraps,
                             const Matrix3d &jumps) const {
  const FieldCells &cells = map.cells();
  const FieldCells::Numbers n = cells.numbers(), at = cells.place(cell);
  Matrix3d products = Matrix3d::Zero(), spread = Matrix3d::Zero();  // m dv dx, m dx dx
  Vector3d first_x = Vector3d::Zero(), first_v = Vector3d::Zero();
  double mass = 0.0;
  const Mean &own = means_[cell];
  const auto add = [&](const Mean &mean, const Vector3d &shift, const Vector3d &jump) {
    const Vector3d dx = map.across() * (shift + mean.centre - own.centre);
    const Vector3d dv = jump + mean.velocity - own.velocity;
    first_x += mean.mass * dx;
    first_v += mean.mass * dv;
    mass += mean.mass;
    products += mean.mass * dv * dx.transpose();
    spread += mean.mass * dx * dx.transpose();
  };
  add(own, Vector3d::Zero(), Vector3d::Zero());
  for (int k = 0; k < 3; k++)
    for (int step : {-1, 1}) {
      if (n[k] == 1) continue;
      FieldCells::Numbers other = at;
      other[k] += step;
      const bool beyond = other[k] < 0 || other[k] >= n[k];
      if (beyond && !wraps[k]) continue;
      if (!beyond) add(means_[cells.cell(other)], Vector3d::Zero(), Vector3d::Zero());
      other[k] -= step * n[k];
      if (beyond) add(means_[cells.cell(other)], step * cells.edges().col(k), step * jumps.col(k));
    }
  products -= first_v * first_x.transpose() / mass;
  spread -= first_x * first_x.transpose() / mass;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(spread);
  Vector3d inverse = Vector3d::Zero();
  for (int k = 0; k < 3; k++)
    if (axes.eigenvalues()[k] > rounding * axes.eigenvalues()[2]) inverse[k] = 1.0 / axes.eigenvalues()[k];
  return products * axes.eigenvectors() * inverse.asDiagonal() * axes.eigenvectors().transpose() * map.across();
}

}

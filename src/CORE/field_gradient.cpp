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
  FieldCells::Numbers step;
  for (step[2] = -1; step[2] <= 1; step[2]++)
    for (step[1] = -1; step[1] <= 1; step[1]++)
      for (step[0] = -1; step[0] <= 1; step[0]++) {
        FieldCells::Numbers other;
        Vector3d dx = Vector3d::Zero(), dv = Vector3d::Zero();
        bool there = true;
        for (int k = 0; k < 3; k++) {
          other[k] = at[k] + step[k];
          there = there && (step[k] == 0 || n[k] > 1);
          const int beyond = other[k] < 0 ? -1 : other[k] >= n[k] ? 1 : 0;
          if (beyond == 0) continue;
          there = there && wraps[k];
          other[k] -= beyond * n[k];
          dx += beyond * cells.numbered_edges().col(k);
          dv += beyond * jumps.col(k);
        }
        if (!there) continue;
        const Mean &mean = means_[cells.cell(other)];
        dx = map.across() * (dx + mean.centre - own.centre);
        dv += mean.velocity - own.velocity;
        first_x += mean.mass * dx;
        first_v += mean.mass * dv;
        mass += mean.mass;
        products += mean.mass * dv * dx.transpose();
        spread += mean.mass * dx * dx.transpose();
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

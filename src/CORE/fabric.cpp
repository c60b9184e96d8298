// SPDX-License-Identifier: GPL-2.0-or-later
#include "fabric.h"
#include <cmath>

namespace grainscope {

using Eigen::Matrix3d;

namespace {

Matrix3d deviator_over(double scale, const Matrix3d &m) {
  if (scale == 0.0) return Matrix3d::Zero();
  return (m - m.trace() / 3.0 * Matrix3d::Identity()) / scale;
}

}

Matrix3d FabricSums::tensor() const {
  if (contacts() == 0.0) return Matrix3d::Zero();
  return symmetric_tensor(sums.data()) / contacts();
}

void WeightedFabricSums::add(const ContactMoment &m, const Matrix3d &fabric) {
  const Eigen::Vector3d &n = m.normal;
  const double anisotropy = 7.5 * (n.dot(fabric * n) - 1.0 / 3.0);
  if (std::fabs(1.0 + anisotropy) < 1e-10) {
    sums[18] += 1.0;
    return;
  }
  const double weight = m.weight / (1.0 + anisotropy);
  const SixComponents nn = dyad(n, n);
  add_components(&sums[0], weight * m.distance, nn);
  add_components(&sums[6], weight * m.normal_force, nn);
  add_components(&sums[12], weight * m.tangential_force, nn);
}

Matrix3d WeightedFabricSums::branch() const {
  if (singular() > 0.0) return Matrix3d::Zero();
  const Matrix3d d = symmetric_tensor(&sums[0]);
  return deviator_over(d.trace() / 7.5, d);
}

Matrix3d WeightedFabricSums::normal_force() const {
  if (singular() > 0.0) return Matrix3d::Zero();
  const Matrix3d n = symmetric_tensor(&sums[6]);
  return deviator_over(n.trace() / 7.5, n);
}

Matrix3d WeightedFabricSums::tangential_force() const {
  if (singular() > 0.0) return Matrix3d::Zero();
  return deviator_over(symmetric_tensor(&sums[6]).trace() / 5.0, symmetric_tensor(&sums[12]));
}

}

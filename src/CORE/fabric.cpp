// SPDX-License-Identifier: GPL-2.0-or-later
#include "fabric.h"
#include <cmath>

namespace grainscope {

using Eigen::Matrix3d;

Matrix3d FabricSums::tensor() const {
  if (contacts() == 0.0) return Matrix3d::Zero();
  return symmetric_tensor(sums.data()) / contacts();
}

double fabric_deviator(const Matrix3d &fabric, int dimension) {
  if (dimension == 2) return std::sqrt(2.0) * deviatoric(fabric, 2).norm();
  // in one expression, whose sum keeps its order
  return std::sqrt(1.5) * (fabric - fabric.trace() / 3.0 * Matrix3d::Identity()).norm();
}

Matrix3d WeightedFabricSums::deviatoric_over(double scale, const Matrix3d &m) const {
  if (scale == 0.0) return Matrix3d::Zero();
  return deviatoric(m, dimension_) / scale;
}

void WeightedFabricSums::add(const ContactMoment &m, const Matrix3d &fabric) {
  const Eigen::Vector3d &n = m.normal;
  const double anisotropy = of_density() * (n.dot(fabric * n) - 1.0 / dimension_);
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
  return deviatoric_over(d.trace() / of_density(), d);
}

Matrix3d WeightedFabricSums::normal_force() const {
  if (singular() > 0.0) return Matrix3d::Zero();
  const Matrix3d n = symmetric_tensor(&sums[6]);
  return deviatoric_over(n.trace() / of_density(), n);
}

Matrix3d WeightedFabricSums::tangential_force() const {
  if (singular() > 0.0) return Matrix3d::Zero();
  return deviatoric_over(symmetric_tensor(&sums[6]).trace() / (dimension_ + 2), symmetric_tensor(&sums[12]));
}

}

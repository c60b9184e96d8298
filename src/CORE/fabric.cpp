// SPDX-License-Identifier: GPL-2.0-or-later
#include "fabric.h"
#include <cmath>

namespace grainscope {

using Eigen::Matrix3d;

namespace {

Matrix3d symmetric(const double *six) {
  Matrix3d m;
  m << six[0], six[3], six[4], six[3], six[1], six[5], six[4], six[5], six[2];
  return m;
}

Matrix3d deviator_over(double scale, const Matrix3d &m) {
  if (scale == 0.0) return Matrix3d::Zero();
  return (m - m.trace() / 3.0 * Matrix3d::Identity()) / scale;
}

}

Matrix3d FabricSums::tensor() const {
  if (contacts() == 0.0) return Matrix3d::Zero();
  return symmetric(sums.data()) / contacts();
}

void WeightedFabricSums::add(const ContactMoment &m, const Matrix3d &fabric) {
  const Eigen::Vector3d &n = m.normal;
  const double anisotropy = 7.5 * (n.dot(fabric * n) - 1.0 / 3.0);
  if (std::fabs(1.0 + anisotropy) < 1e-10) {
    sums[18] += 1.0;
    return;
  }
  const double weight = m.weight / (1.0 + anisotropy);
  const double products[6] = {n[0] * n[0], n[1] * n[1], n[2] * n[2], n[0] * n[1], n[0] * n[2], n[1] * n[2]};
  for (int k = 0; k < 6; k++) {
    sums[k] += weight * m.distance * products[k];
    sums[6 + k] += weight * m.normal_force * products[k];
    sums[12 + k] += weight * m.tangential_force * products[k];
  }
}

Matrix3d WeightedFabricSums::branch() const {
  if (singular() > 0.0) return Matrix3d::Zero();
  const Matrix3d d = symmetric(&sums[0]);
  return deviator_over(d.trace() / 7.5, d);
}

Matrix3d WeightedFabricSums::normal_force() const {
  if (singular() > 0.0) return Matrix3d::Zero();
  const Matrix3d n = symmetric(&sums[6]);
  return deviator_over(n.trace() / 7.5, n);
}

Matrix3d WeightedFabricSums::tangential_force() const {
  if (singular() > 0.0) return Matrix3d::Zero();
  return deviator_over(symmetric(&sums[6]).trace() / 5.0, symmetric(&sums[12]));
}

}

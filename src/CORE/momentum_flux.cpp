// SPDX-License-Identifier: GPL-2.0-or-later
#include "momentum_flux.h"
#include "lane_rows.h"
#include <algorithm>

namespace grainscope {

namespace {

/** What a velocity is measured against: mean + L (x - x_c). */
struct Against {
  double l[6], centre[3], mean[3];

  Against(const AffineFlow &flow, const Eigen::Vector3d &mean) {
    const Eigen::Matrix3d &g = flow.velocity_gradient;
    const double upper[6] = {g(0, 0), g(0, 1), g(0, 2), g(1, 1), g(1, 2), g(2, 2)};
    std::copy(upper, upper + 6, l);
    for (int k = 0; k < 3; k++) {
      centre[k] = flow.centre[k];
      this->mean[k] = mean[k];
    }
  }
  /** Of grain i, or of the four from i on; returns their masses. */
  template <class Real>
  GRAINSCOPE_INLINE Real read(const MovingGrains &grains, int i, Real u[3]) const {
    Real x[3], v[3];
    read_threes(grains.x + 3 * i, x);
    read_threes(grains.v + 3 * i, v);
    for (int k = 0; k < 3; k++) x[k] -= centre[k];
    u[0] = v[0] - (l[0] * x[0] + l[1] * x[1] + l[2] * x[2]) - mean[0];
    u[1] = v[1] - (l[3] * x[1] + l[4] * x[2]) - mean[1];
    u[2] = v[2] - l[5] * x[2] - mean[2];
    return read_ones<Real>(grains.mass + i);
  }
};

template <class Real>
GRAINSCOPE_INLINE void add_momentum(const MovingGrains &grains, int i, const Against &against, Real sums[4]) {
  Real u[3];
  const Real mass = against.read(grains, i, u);
  for (int k = 0; k < 3; k++) sums[k] += mass * u[k];
  sums[3] += mass;
}

template <class Real>
GRAINSCOPE_INLINE void add_flux(const MovingGrains &grains, int i, const Against &against, Real sums[6]) {
  Real u[3];
  const Real mass = against.read(grains, i, u), p[3] = {mass * u[0], mass * u[1], mass * u[2]};
  for (int k = 0; k < 3; k++) sums[k] += p[k] * u[k];
  sums[3] += p[0] * u[1];
  sums[4] += p[0] * u[2];
  sums[5] += p[1] * u[2];
}

}

GRAINSCOPE_CLONES
std::array<double, 4> momentum_of(const MovingGrains &grains, const AffineFlow &flow) {
  const Against against(flow, Eigen::Vector3d::Zero());
  Lanes fours[4] = {};
  std::array<double, 4> sums{};
  int i = 0;
  for (; i + LANES <= grains.count; i += LANES) add_momentum(grains, i, against, fours);
  for (; i < grains.count; i++) add_momentum(grains, i, against, sums.data());
  for (int k = 0; k < 4; k++) sums[k] += sum_of(fours[k]);
  return sums;
}

GRAINSCOPE_CLONES
SixComponents momentum_flux_of(const MovingGrains &grains, const AffineFlow &flow, const Eigen::Vector3d &mean) {
  const Against against(flow, mean);
  Lanes fours[6] = {};
  SixComponents sums{};
  int i = 0;
  for (; i + LANES <= grains.count; i += LANES) add_flux(grains, i, against, fours);
  for (; i < grains.count; i++) add_flux(grains, i, against, sums.data());
  for (int k = 0; k < 6; k++) sums[k] += sum_of(fours[k]);
  return sums;
}

}

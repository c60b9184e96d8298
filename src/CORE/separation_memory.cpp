// SPDX-License-Identifier: GPL-2.0-or-later
#include "separation_memory.h"
#include "lanes.h"
#include <Eigen/LU>
#include <algorithm>

namespace grainscope {

namespace {

using Pose = SeparationMemory::Pose;
using Flow = SeparationMemory::Flow;

/** x: centre, turn: axis or quaternion, each before and now. */
template <class Real>
GRAINSCOPE_INLINE Real motion(const Flow &flow, Real slope, const Real *x_before, const Real *turn_before,
                              const Real *x, const Real *turn) {
  Real r[3], distance2{}, turn2{};
  for (int k = 0; k < 3; k++) r[k] = x_before[k] - flow.origin_before[k];
  for (int k = 0; k < 3; k++) {
    const Real off = x[k] - flow.origin[k] - (flow.f[k][0] * r[0] + flow.f[k][1] * r[1] + flow.f[k][2] * r[2]);
    distance2 += off * off;
  }
  for (int k = 0; k < 4; k++) turn2 += (turn[k] - turn_before[k]) * (turn[k] - turn_before[k]);
  // of a chord c the arc is 2 asin(c/2) <= c (1 + 0.143 c^2)
  return flow.affine + root(distance2) + slope * root(turn2) * (1.0 + 0.143 * turn2);
}

/** Adds to `moved`; returns the most of it. */
GRAINSCOPE_CLONES
double follow_grains(const Flow &flow, int n, const Pose *before, const PackedGrain *grains, const double *slopes,
                     bool alike, double *moved) {
  Lanes most{};
  int i = 0;
  for (; i + LANES <= n; i += LANES) {
    Lanes x[4], turn[4], x_before[4], turn_before[4];
    load_rows([&](int k) { return grains[i + k].x; }, x);
    load_rows([&](int k) { return grains[i + k].axis; }, turn);
    load_rows([&](int k) { return before[i + k].x; }, x_before);
    load_rows([&](int k) { return before[i + k].turn; }, turn_before);
    const Lanes slope = alike ? slopes[0] + Lanes{} : load(slopes + i);
    const Lanes now = load(moved + i) + motion(flow, slope, x_before, turn_before, x, turn);
    store(now, moved + i);
    most = pick(most < now, now, most);
  }
  double result = std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
  for (; i < n; i++) {
    const Pose now = SeparationMemory::pose_of(grains[i]);
    moved[i] += motion(flow, slopes[alike ? 0 : i], before[i].x, before[i].turn, now.x, now.turn);
    result = std::max(result, moved[i]);
  }
  return result;
}

}

void SeparationMemory::set_flow(const Eigen::Matrix3d &edges, const Eigen::Vector3d &origin) {
  if (known_) {
    const Eigen::Matrix3d f = edges * edges_.inverse();
    for (int k = 0; k < 3; k++) {
      for (int l = 0; l < 3; l++) flow_.f[k][l] = f(k, l);
      flow_.origin_before[k] = origin_[k];
      flow_.origin[k] = origin[k];
    }
    // per grain, for r up to 1.5 times the reach
    flow_.affine = 0.75 * reach_ * (f - Eigen::Matrix3d::Identity()).norm();
  }
  edges_ = edges;
  origin_ = origin;
  known_ = true;
}

void SeparationMemory::follow(int first, int many, const Pose *before, const PackedGrain *grains) {
  const double *slopes = alike_ ? slopes_.data() : &slopes_[first];
  most_moved_ = std::max(most_moved_, follow_grains(flow_, many, before, grains, slopes, alike_, &moved_[first]));
}

}

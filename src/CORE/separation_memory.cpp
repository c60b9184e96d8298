// SPDX-License-Identifier: GPL-2.0-or-later
#include "separation_memory.h"
#include "lanes.h"
#include <Eigen/LU>
#include <algorithm>

namespace grainscope {

namespace {

using Pose = SeparationMemory::Pose;

/** How the box takes its grains along: x = f (x_before - origin_before) + origin; what of that counts as motion. */
struct Flow {
  double f[3][3], origin_before[3], origin[3], affine;
};

/** x: centre and elongation, turn: quaternion, each before and now. */
template <class Real>
GRAINSCOPE_INLINE Real motion(const Flow &flow, const Real *x_before, const Real *turn_before, const Real *x,
                              const Real *turn) {
  Real r[3], distance2{}, turn2{};
  for (int k = 0; k < 3; k++) r[k] = x_before[k] - flow.origin_before[k];
  for (int k = 0; k < 3; k++) {
    const Real off = x[k] - flow.origin[k] - (flow.f[k][0] * r[0] + flow.f[k][1] * r[1] + flow.f[k][2] * r[2]);
    distance2 += off * off;
  }
  for (int k = 0; k < 4; k++) turn2 += (turn[k] - turn_before[k]) * (turn[k] - turn_before[k]);
  // phi = 4 asin(|dq|/2) <= 2 |dq| (1 + 0.143 |dq|^2)
  return flow.affine + root(distance2) + x_before[3] * 2.0 * root(turn2) * (1.0 + 0.143 * turn2);
}

void keep(const PackedGrain &grain, const double *turn, Pose &pose) {
  std::copy(grain.x, grain.x + 3, pose.x);
  std::copy(turn, turn + 4, pose.turn);
}

/** Adds to `moved`; returns the most of it. */
GRAINSCOPE_CLONES
double follow(const Flow &flow, int n, const PackedGrain *grains, const double *turns, Pose *poses, double *moved) {
  Lanes most{};
  int i = 0;
  for (; i + LANES <= n; i += LANES) {
    Lanes x[4], turn[4], x_before[4], turn_before[4];
    load_rows([&](int k) { return grains[i + k].x; }, x);
    load_rows([&](int k) { return turns + 4 * (i + k); }, turn);
    load_rows([&](int k) { return poses[i + k].x; }, x_before);
    load_rows([&](int k) { return poses[i + k].turn; }, turn_before);
    const Lanes now = load(moved + i) + motion(flow, x_before, turn_before, x, turn);
    store(now, moved + i);
    most = pick(most < now, now, most);
    x[3] = x_before[3];
    Lanes rows[4];
    transpose(x, rows);
    for (int k = 0; k < LANES; k++) {
      store(rows[k], poses[i + k].x);
      store(load(turns + 4 * (i + k)), poses[i + k].turn);
    }
  }
  double result = std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
  for (; i < n; i++) {
    moved[i] += motion(flow, poses[i].x, poses[i].turn, grains[i].x, turns + 4 * i);
    keep(grains[i], turns + 4 * i, poses[i]);
    result = std::max(result, moved[i]);
  }
  return result;
}

}

void SeparationMemory::move(const Eigen::Matrix3d &edges, const Eigen::Vector3d &origin, const PackedGrain *grains,
                            const double *quaternions) {
  const int n = static_cast<int>(moved_.size());
  if (known_) {
    const Eigen::Matrix3d f = edges * edges_.inverse();
    Flow flow;
    for (int k = 0; k < 3; k++) {
      for (int l = 0; l < 3; l++) flow.f[k][l] = f(k, l);
      flow.origin_before[k] = origin_[k];
      flow.origin[k] = origin[k];
    }
    // per grain, for r up to 1.5 times the reach
    flow.affine = 0.75 * reach_ * (f - Eigen::Matrix3d::Identity()).norm();
    most_moved_ = follow(flow, n, grains, quaternions, poses_.data(), moved_.data());
  } else {
    for (int i = 0; i < n; i++) keep(grains[i], quaternions + 4 * i, poses_[i]);
    known_ = true;
  }
  edges_ = edges;
  origin_ = origin;
}

}

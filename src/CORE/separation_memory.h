// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SEPARATION_MEMORY_H
#define GRAINSCOPE_SEPARATION_MEMORY_H

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

namespace grainscope {

/** Which neighbours need no look: a pair that was once found `gap` apart stays apart until its two grains have together
 *  moved and turned by as much. Motion is measured against the affine motion of the box, so that a shear flow spends
 *  little of it. Rigorous: a displacement changes a distance by at most its length; a turn by phi by at most (longest -
 *  shortest semi-axis) phi, the largest slope of an ellipsoid's support function; the affine part, F r - r, by at most
 *  |F - 1| r, bounded for r up to 1.5 times the reach: farther apart the pairs of a neighbour list that is fit for use
 *  are never. */
class SeparationMemory {
 public:
  /** A new neighbour list: nothing is known. Pairs of it are at most `reach` apart, centre to centre. */
  void restart(int grains, int pairs, double reach) {
    pose_.clear();
    moved_.assign(grains, 0.0);
    apart_until_.assign(pairs, 0.0f);
    most_moved_ = 0.0;
    reach_ = reach;
  }

  /** The grains as they are now: the box (edges in columns, origin), positions, unit quaternions; elongation(i) is the
   *  longest less the shortest semi-axis of grain i. */
  template <class Elongation>
  void move(const Eigen::Matrix3d &edges, const Eigen::Vector3d &origin, const double *const *x,
            const double *const *quaternion, Elongation elongation);

  double moved(int grain) const { return moved_[grain]; }
  /** Of all grains. */
  double most_moved() const { return most_moved_; }
  /** False only if the pair is surely apart. `motion` is the sum of moved() of its two grains. */
  bool may_touch(int pair, double motion) const { return motion >= apart_until_[pair]; }
  /** False only if the pair is surely apart until its motion has become `motion`. */
  bool may_touch_before(int pair, double motion) const { return apart_until_[pair] <= motion; }
  void set_touching(int pair) { apart_until_[pair] = 0.0f; }
  /** Of a pair now at least `gap` apart; the margin is for the rounding of all that is summed up here. */
  void set_apart(int pair, double gap, double motion) {
    apart_until_[pair] = gap > 1e-9 * reach_ ? static_cast<float>((motion + gap) * (1.0 - 1e-6)) : 0.0f;
  }

 private:
  struct Pose {
    double x[3], q[4];
  };
  std::vector<Pose> pose_;  // at the last move
  std::vector<double> moved_;
  std::vector<float> apart_until_;
  double most_moved_ = 0.0;
  double reach_ = 0.0;
  Eigen::Matrix3d edges_;
  Eigen::Vector3d origin_;
};

template <class Elongation>
void SeparationMemory::move(const Eigen::Matrix3d &edges, const Eigen::Vector3d &origin, const double *const *x,
                            const double *const *quaternion, Elongation elongation) {
  const int n = static_cast<int>(moved_.size());
  const bool first = pose_.empty();
  pose_.resize(n);
  if (!first) {
    const Eigen::Matrix3d f = edges * edges_.inverse();
    // per grain, for r up to 1.5 times the reach
    const double affine = 0.75 * reach_ * (f - Eigen::Matrix3d::Identity()).norm();
    for (int i = 0; i < n; i++) {
      const Pose &old = pose_[i];
      const double r0 = old.x[0] - origin_[0], r1 = old.x[1] - origin_[1], r2 = old.x[2] - origin_[2];
      double distance2 = 0.0;
      for (int k = 0; k < 3; k++) {
        const double off = x[i][k] - origin[k] - (f(k, 0) * r0 + f(k, 1) * r1 + f(k, 2) * r2);
        distance2 += off * off;
      }
      moved_[i] += affine + std::sqrt(distance2);
      const double slope = elongation(i);
      if (slope != 0.0) {
        double turn2 = 0.0;  // phi = 4 asin(|dq|/2) <= 2 |dq| (1 + 0.143 |dq|^2)
        for (int k = 0; k < 4; k++) turn2 += (quaternion[i][k] - old.q[k]) * (quaternion[i][k] - old.q[k]);
        moved_[i] += slope * 2.0 * std::sqrt(turn2) * (1.0 + 0.143 * turn2);
      }
      most_moved_ = std::max(most_moved_, moved_[i]);
    }
  }
  for (int i = 0; i < n; i++) {
    std::copy(x[i], x[i] + 3, pose_[i].x);
    std::copy(quaternion[i], quaternion[i] + 4, pose_[i].q);
  }
  edges_ = edges;
  origin_ = origin;
}

}

#endif

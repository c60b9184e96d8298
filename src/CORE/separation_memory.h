// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SEPARATION_MEMORY_H
#define GRAINSCOPE_SEPARATION_MEMORY_H

#include "fitted.h"
#include "packed_grain.h"
#include <Eigen/Core>
#include <algorithm>
#include <cstring>
#include <vector>

namespace grainscope {

/** Pairs of neighbours that need not be checked: a pair that was found `gap` apart stays apart until its two grains
 *  together have moved and turned by as much. Motion is measured relative to the affine motion of the box, so that a
 *  shear flow uses up little of the gap. The bounds are rigorous. A displacement changes a distance by at most its
 *  length; a turn by phi by at most (longest - shortest semi-axis) phi, the largest slope of an ellipsoid's support
 *  function; the affine part, F r - r, by at most |F - 1| r, bounded for r up to 1.5 times the reach. The pairs of a
 *  valid neighbour list are never farther apart. */
class SeparationMemory {
 public:
  /** A new neighbour list: nothing is known. Pairs of it are at most `reach` apart, centre to centre. slope(i): how
   *  much nearer a small change of the last row of PackedGrain (axis or quaternion) may bring the surface of grain i,
   *  or with `alike` of any, over the length of that change. */
  template <class Slope>
  void restart(int grains, int pairs, double reach, bool alike, Slope slope) {
    known_ = false;
    fit(slopes_, alike ? 1 : grains);
    for (std::size_t i = 0; i < slopes_.size(); i++) slopes_[i] = slope(i);
    alike_ = alike;
    fit(moved_, grains);
    std::fill(moved_.begin(), moved_.end(), 0.0);
    most_moved_ = 0.0;
    fit(apart_until_, pairs);
    std::fill(apart_until_.begin(), apart_until_.end(), 0.0f);
    reach_ = reach;
  }

  /** The box as it is now (edges in columns, origin), and the grains as they were at the last move. load(first, many)
   *  brings some of them to where they are now. */
  template <class Load>
  void move(const Eigen::Matrix3d &edges, const Eigen::Vector3d &origin, const PackedGrain *grains, Load load) {
    const int n = static_cast<int>(moved_.size());
    const bool follows = known_;
    set_flow(edges, origin);
    for (int first = 0; first < n; first += CHUNK) {
      const int many = std::min(CHUNK, n - first);
      Pose before[CHUNK];
      for (int k = 0; follows && k < many; k++) before[k] = pose_of(grains[first + k]);
      load(first, many);
      if (follows) follow(first, many, before, grains + first);
    }
  }

  double moved(int grain) const { return moved_[grain]; }
  /** Of all grains. */
  double most_moved() const { return most_moved_; }
  /** False only if the pair is surely apart. `motion` is the sum of moved() of its two grains. */
  bool may_touch(int pair, double motion) const { return motion >= apart_until_[pair]; }
  /** False only if the pair is surely apart until its motion has become `motion`. */
  bool may_touch_before(int pair, double motion) const { return apart_until_[pair] <= motion; }
  /** It will be asked for soon. */
  void prefetch(int grain, int pair) const {
    __builtin_prefetch(&moved_[grain]);
    __builtin_prefetch(&apart_until_[pair], 1);
  }
  void set_touching(int pair) { apart_until_[pair] = 0.0f; }
  /** Of a pair now at least `gap` apart; the margin is for the rounding of all that is summed up here. */
  void set_apart(int pair, double gap, double motion) {
    apart_until_[pair] = gap > 1e-9 * reach_ ? static_cast<float>((motion + gap) * (1.0 - 1e-6)) : 0.0f;
  }

  /** A grain as it was at the last move: the first and the last row of PackedGrain. */
  struct Pose {
    double x[4], turn[4];
  };
  static Pose pose_of(const PackedGrain &grain) {
    Pose pose;
    std::memcpy(pose.x, grain.x, sizeof pose.x);
    std::memcpy(pose.turn, grain.axis, sizeof pose.turn);
    return pose;
  }
  /** How the box takes its grains along: x = f (x_before - origin_before) + origin; what of that counts as motion. */
  struct Flow {
    double f[3][3], origin_before[3], origin[3], affine;
  };

 private:
  static constexpr int CHUNK = 64;  // grains at a time, which stay in the cache
  bool known_ = false;
  std::vector<double> slopes_, moved_;
  bool alike_ = false;
  std::vector<float> apart_until_;
  double most_moved_ = 0.0, reach_ = 0.0;
  Flow flow_;
  Eigen::Matrix3d edges_;
  Eigen::Vector3d origin_;

  void set_flow(const Eigen::Matrix3d &edges, const Eigen::Vector3d &origin);
  void follow(int first, int many, const Pose *before, const PackedGrain *grains);
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SEPARATION_MEMORY_H
#define GRAINSCOPE_SEPARATION_MEMORY_H

#include "packed_grain.h"
#include <Eigen/Core>
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
  /** A new neighbour list: nothing is known. Pairs of it are at most `reach` apart, centre to centre. elongation(i): of
   *  grain i, its longest less its shortest semi-axis. */
  template <class Elongation>
  void restart(int grains, int pairs, double reach, Elongation elongation) {
    known_ = false;
    poses_.resize(grains);
    for (int i = 0; i < grains; i++) poses_[i].elongation = elongation(i);
    moved_.assign(grains, 0.0);
    most_moved_ = 0.0;
    apart_until_.assign(pairs, 0.0f);
    reach_ = reach;
  }

  /** The grains as they are now: the box (edges in columns, origin), centres, and unit quaternions, one after the
   *  other. */
  void move(const Eigen::Matrix3d &edges, const Eigen::Vector3d &origin, const PackedGrain *grains,
            const double *quaternions);

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

  /** A grain as it was at the last move. */
  struct alignas(64) Pose {
    double x[3], elongation, turn[4];
  };

 private:
  std::vector<Pose> poses_;
  bool known_ = false;
  std::vector<double> moved_;
  std::vector<float> apart_until_;
  double most_moved_ = 0.0, reach_ = 0.0;
  Eigen::Matrix3d edges_;
  Eigen::Vector3d origin_;
};

}

#endif

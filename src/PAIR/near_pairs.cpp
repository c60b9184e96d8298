// SPDX-License-Identifier: GPL-2.0-or-later
#include "near_pairs.h"

namespace grainscope {

void NearPairs::choose(const LAMMPS_NS::NeighList &list, const LAMMPS_NS::NeighList *history, int columns,
                       const SeparationMemory &apart) {
  const double most = 2.0 * apart.most_moved();
  const double growth = most - most_;
  most_ = most;
  if (chosen_ && most < good_until_) return;
  // In the first evaluation nothing is known: all are near, for once.
  good_until_ = chosen_ || most > 0.0 ? most + STEPS * growth : 0.0;
  chosen_ = true;
  pairs_.clear();
  int number = 0;
  for (int ii = 0; ii < list.inum; ii++) {
    const int i = list.ilist[ii], neighbours = list.numneigh[i];
    const int *partners = list.firstneigh[i];
    for (int jj = 0; jj < neighbours; jj++, number++) {
      if (!apart.may_touch_before(number, good_until_)) continue;
      pairs_.push_back({i, partners[jj] & NEIGHMASK, number, history ? history->firstneigh[i] + jj : nullptr,
                        history ? history->firstdouble[i] + columns * jj : nullptr});
    }
  }
  pairs_.resize(pairs_.size() + AHEAD, pairs_.empty() ? Pair{} : pairs_.back());
  listed_ = number;
}

}

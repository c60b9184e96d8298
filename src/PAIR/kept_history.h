// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_KEPT_HISTORY_H
#define GRAINSCOPE_KEPT_HISTORY_H

#include "neigh_list.h"
#include <algorithm>
#include <vector>

namespace grainscope {

/** Restores the contact history, so that an evaluation for output only does not change the trajectory. */
class KeptHistory {
 public:
  /** `history` may be null: then there is none to keep. */
  KeptHistory(LAMMPS_NS::NeighList *history, const LAMMPS_NS::NeighList *list, int width)
      : history_(history), list_(list), width_(width) {
    if (!history_) return;
    for (int ii = 0; ii < list_->inum; ii++) {
      const int i = list_->ilist[ii], n = list_->numneigh[i];
      values_.insert(values_.end(), history_->firstdouble[i], history_->firstdouble[i] + n * width_);
      flags_.insert(flags_.end(), history_->firstneigh[i], history_->firstneigh[i] + n);
    }
  }
  KeptHistory(const KeptHistory &) = delete;
  KeptHistory &operator=(const KeptHistory &) = delete;

  ~KeptHistory() {
    if (!history_) return;
    auto value = values_.begin();
    auto flag = flags_.begin();
    for (int ii = 0; ii < list_->inum; ii++) {
      const int i = list_->ilist[ii], n = list_->numneigh[i];
      std::copy(value, value + n * width_, history_->firstdouble[i]);
      std::copy(flag, flag + n, history_->firstneigh[i]);
      value += n * width_;
      flag += n;
    }
  }

 private:
  LAMMPS_NS::NeighList *history_;
  const LAMMPS_NS::NeighList *list_;
  int width_;
  std::vector<double> values_;
  std::vector<int> flags_;
};

}

#endif

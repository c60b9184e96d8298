// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_NEIGHBOUR_LIST_WATCH_H
#define GRAINSCOPE_NEIGHBOUR_LIST_WATCH_H

#include "neighbor.h"
#include "update.h"

namespace grainscope {

/** Reports whether neighbour lists, or grains between two runs, have changed since the last call. The same on all
 *  ranks. */
class NeighbourListWatch {
 public:
  bool renewed(const LAMMPS_NS::Neighbor &neighbor, const LAMMPS_NS::Update &update) {
    if (neighbor.ago != 0 && built_ == neighbor.lastcall && run_ == update.firststep) return false;
    built_ = neighbor.lastcall;
    run_ = update.firststep;
    return true;
  }

 private:
  LAMMPS_NS::bigint built_ = -1, run_ = -1;
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_LOSS_LANES_H
#define GRAINSCOPE_LOSS_LANES_H

#include "contact_lanes.h"
#include "loss_sums.h"

namespace grainscope {

/** The sums of a LossSums over contacts between grains, lane by lane. */
class LossLanes {
 public:
  static bool need_motion(const LossSums &sums) { return sums.of == LossSums::Of::powers; }
  void add(const ContactLanes &contacts, const LossSums &sums);
  /** Adds what was added up, and forgets it. */
  void move_to(LossSums &sums);

 private:
  Lanes all_[LossSums::WIDTH]{};
};

}

#endif

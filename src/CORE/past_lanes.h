// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PAST_LANES_H
#define GRAINSCOPE_PAST_LANES_H

#include "pair_group.h"

namespace grainscope {

/** The ContactPast of contacts side by side; 0 where nothing is known of it. */
struct PastLanes {
  LaneMask known;
  Lanes overlap, elastic_force, tangential_stiffness, elastic_work, spring_work;
};

/** How contacts keep it in their history: a stamp, which tells the evaluation, and then the five numbers. */
struct PastColumns {
  static constexpr int count = 6;
  int first;  // as an offset from PairGroup::history
  double stamp, stamp_before;
  double half_step;
};

/** Takes the past of the contacts that touch from their history, and leaves there what they are now. `forces`: with
 *  motion and springs. */
void renew_past(const PairGroup &group, const LaneMask &touching, const GroupForces &forces, const PastColumns &columns,
                PastLanes &past);

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_STRESS_LANES_H
#define GRAINSCOPE_STRESS_LANES_H

#include "contact_lanes.h"
#include "stress.h"

namespace grainscope {

/** The sums of a StressSums, lane by lane. */
class StressLanes {
 public:
  static constexpr bool need_motion(const StressSums &) { return false; }
  void add(const ContactLanes &contacts, const StressSums &);
  /** Adds what was added up, and forgets it. */
  void move_to(StressSums &sums);

 private:
  Lanes moments_[18]{}, contacts_{}, sliding_{}, overlaps_{}, largest_overlap_{};
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#include "stress_lanes.h"

namespace grainscope {

/** As StressSums::add() has it. */
GRAINSCOPE_CLONES
void StressLanes::add(const ContactLanes &c, const StressSums &) {
  const GroupForces &f = c.forces;
  const Lanes normal_force = c.normal_force();
  Lanes forces[6];
  for (int a = 0; a < 3; a++) {
    forces[a] = f.force[a];
    forces[3 + a] = c.tangential_force(a, normal_force);
  }
  for (int b = 0; b < 3; b++) {
    const Lanes r = f.weight * c.branch(b);
    for (int a = 0; a < 6; a++) moments_[6 * b + a] += forces[a] * r;
  }
  contacts_ += f.weight;
  sliding_ += pick(f.cut, f.weight, Lanes{});
  overlaps_ += f.weight * f.overlap;
  largest_overlap_ = pick(largest_overlap_ < f.overlap, f.overlap, largest_overlap_);
}

void StressLanes::move_to(StressSums &to) {
  for (int k = 0; k < 18; k++) to.sums[k] += sum_of(moments_[k]);
  to.sums[18] += sum_of(contacts_);
  to.sums[20] += sum_of(sliding_);
  to.sums[21] += sum_of(overlaps_);
  for (int k = 0; k < LANES; k++) to.largest_overlap = std::max(to.largest_overlap, largest_overlap_[k]);
  *this = StressLanes();
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "loss_lanes.h"

namespace grainscope {

/** As LossSums::add() has it. */
GRAINSCOPE_CLONES
void LossLanes::add(const ContactLanes &c, const LossSums &sums) {
  const GroupForces &f = c.forces;
  const Lanes sliding = pick(f.cut, f.weight, Lanes{});
  all_[LossSums::contacts] += f.weight;
  all_[LossSums::sliding] += sliding;
  // a force that was cut is as large as the limit
  if (sums.of == LossSums::Of::slip) all_[LossSums::friction] += f.weight * f.limit * c.slip();
  if (sums.of != LossSums::Of::powers) return;
  const Lanes normal_force = c.normal_force(), *u = f.tangential_velocity;
  Lanes friction{}, square{};
  for (int k = 0; k < 3; k++) {
    friction -= c.tangential_force(k, normal_force) * u[k];
    square += u[k] * u[k];
  }
  all_[LossSums::normal_damping] -= f.weight * c.normal_damping() * f.normal_velocity;
  all_[LossSums::friction] += sliding * friction;
  all_[LossSums::tangential_damping] += f.weight * c.tangential_damping() * square;
}

void LossLanes::move_to(LossSums &sums) {
  for (int k = 0; k < LossSums::WIDTH; k++) {
    sums.of_grains()[k] += sum_of(all_[k]);
    all_[k] = Lanes{};
  }
}

}

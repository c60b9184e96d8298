// SPDX-License-Identifier: GPL-2.0-or-later
#include "network_lanes.h"

namespace grainscope {

/** As NetworkResponse::add() and ContactStiffness have it. */
GRAINSCOPE_CLONES
void NetworkLanes::add(const ContactLanes &c, const NetworkResponse::Pairs &pairs) {
  const GroupForces &f = c.forces;
  Lanes force[3], branch[3];
  for (int k = 0; k < 3; k++) {
    force[k] = f.weight * f.force[k];
    branch[k] = c.branch(k);
  }
  for (int mode = 0; mode < number_of_box_modes; mode++)
    pressure_[mode] += force[box_modes[mode].flow] * branch[box_modes[mode].gradient];
  if (pairs.pairs_.empty()) return;
  const Lanes k_n = c.law.exponent * f.kn, k_t = c.law.sticks() ? f.kt : Lanes{},
              gamma_t = c.law.tangential == TangentialLaw::none ? Lanes{} : pick(f.cut, Lanes{}, f.gamma_t);
  for (const NetworkResponse::Pairs::Pair &pair : pairs.pairs_) {
    const Lanes along = f.normal[pair.a.flow] * f.normal[pair.b.flow], across = pair.same_flow - along,
                wr2 = f.weight * branch[pair.a.gradient] * branch[pair.b.gradient];
    stiffness_[pair.place] += wr2 * (k_n * along + k_t * across);
    damping_[pair.place] += wr2 * (f.gamma_n * along + gamma_t * across);
  }
}

NetworkResponse NetworkLanes::sum() const {
  NetworkResponse response;
  for (std::size_t k = 0; k < pressure_.size(); k++) response.pressure[k] = sum_of(pressure_[k]);
  for (std::size_t k = 0; k < stiffness_.size(); k++) {
    response.stiffness[k] = sum_of(stiffness_[k]);
    response.damping[k] = sum_of(damping_[k]);
  }
  return response;
}

}

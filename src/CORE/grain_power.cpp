// SPDX-License-Identifier: GPL-2.0-or-later
#include "grain_power.h"
#include "contact_lanes.h"
#include "group_wrenches.h"

namespace grainscope {

namespace {

GRAINSCOPE_INLINE void torque_of(const Lanes *arm, const Lanes *force, Lanes *torque) {
  for (int k = 0; k < 3; k++) {
    const int l = (k + 1) % 3, m = (k + 2) % 3;
    torque[k] = arm[l] * force[m] - arm[m] * force[l];
  }
}

}

GRAINSCOPE_CLONES
void GrainPower::add(const ContactLanes &c, const Lanes *force) {
  used_ = true;
  Lanes arm_j[3], back[3], torque_i[3], torque_j[3];
  for (int k = 0; k < 3; k++) {
    arm_j[k] = c.forces.arm[k] + c.branch(k);
    back[k] = -force[k];
  }
  torque_of(c.forces.arm, force, torque_i);
  torque_of(arm_j, back, torque_j);
  add_wrenches(c.group, c.geometry.touching, force, torque_i, torque_j, static_cast<int>(wrenches_.size()) - 1,
               wrenches_.data());
}

GRAINSCOPE_CLONES
double GrainPower::power(const double *v, const double *omega) const {
  if (!used_) return 0.0;
  const std::size_t last = wrenches_.size() - 2;
  Lanes sum{};  // the fourth is nobody's
  for (std::size_t i = 0; i < last; i++)
    sum += load(wrenches_[i].force) * load(v + 3 * i) + load(wrenches_[i].torque) * load(omega + 3 * i);
  for (int k = 0; k < 3; k++)
    sum[k] += wrenches_[last].force[k] * v[3 * last + k] + wrenches_[last].torque[k] * omega[3 * last + k];
  return sum[0] + sum[1] + sum[2] - image_power_;
}

}

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

GRAINSCOPE_INLINE void GrainPower::add(const ContactLanes &c, const Lanes *force, const Images &images) {
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
  const LaneMask ghost = c.forces.weight == 0.5;
  if (!images.bit || !any(ghost)) return;
  const Eigen::Matrix3d &h = images.edge_velocities;
  const Lanes along[3] = {h(0, 0) * force[0], h(0, 1) * force[0] + h(1, 1) * force[1],
                          h(0, 2) * force[0] + h(1, 2) * force[1] + h(2, 2) * force[2]};
  for (int k = 0; k < LANES; k++) {
    const int j = c.group.j[k];
    if (!ghost[k] || !(images.mask[j] & images.bit)) continue;
    const double *shift = images.shifts + 3 * j;
    image_power_ += 0.5 * (along[0][k] * shift[0] + along[1][k] * shift[1] + along[2][k] * shift[2]);
  }
}

GRAINSCOPE_CLONES
void GrainPower::add_damping(const ContactLanes &c, const Images &images, GrainPower &normal, GrainPower &tangential) {
  Lanes force[3];
  const Lanes size = c.normal_damping(), against = c.tangential_damping();
  for (int k = 0; k < 3; k++) force[k] = size * c.forces.normal[k];
  normal.add(c, force, images);
  if (!any(against > 0.0)) return;
  for (int k = 0; k < 3; k++) force[k] = -against * c.forces.tangential_velocity[k];
  tangential.add(c, force, images);
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

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_GRAIN_POWER_H
#define GRAINSCOPE_GRAIN_POWER_H

#include "contact.h"
#include <Eigen/Geometry>
#include <vector>

namespace grainscope {

/** Collects one kind of contact force per grain (force and torque), to be paired later with velocities that the contact
 *  loop does not know: those at the END of the step. A ghost partner's velocity differs from its owner's by the
 *  velocity of its image,
 *  V = dH/dt . shift; that part is summed contact by contact. */
class GrainPower {
 public:
  void reset(int n_local) {
    if (used_ || wrenches_.size() != 6 * static_cast<std::size_t>(n_local)) wrenches_.assign(6 * n_local, 0.0);
    image_power_ = 0.0;
    used_ = false;
  }

  /** Force on i at the contact point and its opposite on the partner; `image_velocity` is that of a ghost j or a wall,
   *  else ignored. */
  void add(const Contact &c, const Eigen::Vector3d &force, const Eigen::Vector3d &lever_i,
           const Eigen::Vector3d &lever_j, const Eigen::Vector3d &image_velocity) {
    used_ = true;
    add_wrench(c.i, force, lever_i);
    if (c.with_own_grain()) add_wrench(c.j(), -force, lever_j);
    else image_power_ += c.weight * force.dot(image_velocity);
  }

  /** Power of the collected forces with these velocities, over this rank's grains; the sum over ranks is sum F . (v_i -
   *  v_j). */
  double power(const double *const *v, const double *const *omega) const {
    if (!used_) return 0.0;
    double sum = -image_power_;
    for (std::size_t i = 0; 6 * i < wrenches_.size(); i++)
      for (int k = 0; k < 3; k++) sum += wrenches_[6 * i + k] * v[i][k] + wrenches_[6 * i + 3 + k] * omega[i][k];
    return sum;
  }

 private:
  std::vector<double> wrenches_;  // force, torque per local grain
  double image_power_ = 0.0;
  bool used_ = false;

  void add_wrench(int i, const Eigen::Vector3d &force, const Eigen::Vector3d &lever) {
    Eigen::Matrix<double, 6, 1> wrench;
    wrench << force, lever.cross(force);
    Eigen::Map<Eigen::Matrix<double, 6, 1>>(&wrenches_[6 * i]) += wrench;
  }
};

}

#endif

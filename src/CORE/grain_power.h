// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_GRAIN_POWER_H
#define GRAINSCOPE_GRAIN_POWER_H

#include "contact.h"
#include "lanes.h"
#include "packed_grain.h"
#include <Eigen/Geometry>
#include <vector>

namespace grainscope {

struct ContactLanes;

/** Sums one kind of contact force per grain (force and torque), to be paired later with velocities that are not known
 *  in the contact loop: those at the END of the step. The velocity of a ghost differs from that of its owner by the
 *  velocity of its image, V = dH/dt . shift; that part is summed contact by contact. */
class GrainPower {
 public:
  void reset(int n_local) {
    if (used_ || wrenches_.size() != static_cast<std::size_t>(n_local) + 1)
      wrenches_.assign(n_local + 1, PackedForce());  // the last takes what is for ghosts
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
  /** Velocities of ghosts against their owners: dH/dt . shift, of grains whose mask has the bit. */
  struct Images {
    const Eigen::Matrix3d &edge_velocities;  // upper triangular
    const double *shifts;                    // three numbers for each grain or ghost
    const int *mask;
    int bit;  // 0: none have one
  };
  /** The damping forces of contacts side by side. */
  static void add_damping(const ContactLanes &contacts, const Images &images, GrainPower &normal,
                          GrainPower &tangential);

  /** Power of the collected forces with these velocities, rows of three numbers, over this rank's grains; the sum over
   *  ranks is sum F . (v_i - v_j). */
  double power(const double *v, const double *omega) const;

 private:
  std::vector<PackedForce> wrenches_;  // of each local grain
  double image_power_ = 0.0;
  bool used_ = false;

  void add(const ContactLanes &contacts, const Lanes *force, const Images &images);
  void add_wrench(int i, const Eigen::Vector3d &force, const Eigen::Vector3d &lever) {
    Eigen::Map<Eigen::Vector3d>(wrenches_[i].force) += force;
    Eigen::Map<Eigen::Vector3d>(wrenches_[i].torque) += lever.cross(force);
  }
};

}

#endif

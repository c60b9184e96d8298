// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PECULIAR_MOTION_H
#define GRAINSCOPE_PECULIAR_MOTION_H

#include "box_state.h"
#include <vector>

namespace LAMMPS_NS { class LAMMPS; }

namespace grainscope {

/** How a group moves against the affine flow of the box, u = v - L(x - x_c): its number of grains and mean (by mass), over all ranks. Collective. */
class PeculiarMotion {
 public:
  PeculiarMotion(LAMMPS_NS::LAMMPS *lmp, int groupbit, const BoxState &box);

  double grains() const { return grains_; }
  /** Mass-weighted mean of u; zero for an empty group. */
  const Eigen::Vector3d &drift() const { return drift_; }
  /** Sum m dv dv with dv = u - drift, over all ranks. Collective. */
  Eigen::Matrix3d momentum_flux() const;

 private:
  struct Grain {
    double mass;
    Eigen::Vector3d u;
  };
  LAMMPS_NS::LAMMPS *lmp_;
  std::vector<Grain> local_;
  double grains_;
  Eigen::Vector3d drift_;
};

}

#endif

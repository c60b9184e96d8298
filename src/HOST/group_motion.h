// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_GROUP_MOTION_H
#define GRAINSCOPE_GROUP_MOTION_H

#include "box_state.h"

namespace LAMMPS_NS { class LAMMPS; }

namespace grainscope {

/** Mass and mean peculiar velocity of a group: v - L(x - x_c), averaged by mass. Collective. */
struct GroupMotion {
  GroupMotion(LAMMPS_NS::LAMMPS *lmp, int groupbit, const BoxState &box);

  double grains = 0.0;
  double mass = 0.0;
  Eigen::Vector3d drift = Eigen::Vector3d::Zero();  // zero for an empty group
};

/** Sum m dv dv over the group, dv = v - L(x - x_c) - drift. Collective. */
Eigen::Matrix3d peculiar_momentum_flux(LAMMPS_NS::LAMMPS *lmp, int groupbit, const BoxState &box, const GroupMotion &motion);

/** Mass of grain i. */
double mass_of(LAMMPS_NS::LAMMPS *lmp, int i);

}

#endif

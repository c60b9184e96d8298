// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_GROUP_WRENCHES_H
#define GRAINSCOPE_GROUP_WRENCHES_H

#include "lane_vectors.h"
#include "pair_group.h"
#include <algorithm>

namespace grainscope {

/** Adds forces on i, their opposites on j, and torques on both to the grains, pair after pair of those that touch.
 *  `forces`: of the `own` first grains, and of one more, which takes what is for ghosts. */
GRAINSCOPE_INLINE void add_wrenches(const PairGroup &group, const LaneMask &touching, const Lanes *force,
                                    const Lanes *torque_i, const Lanes *torque_j, int own, PackedForce *forces) {
  Lanes f[LANES], ti[LANES], tj[LANES];
  const Lanes columns[3][4] = {{force[0], force[1], force[2], force[2]},
                               {torque_i[0], torque_i[1], torque_i[2], torque_i[2]},
                               {torque_j[0], torque_j[1], torque_j[2], torque_j[2]}};
  transpose(columns[0], f);
  transpose(columns[1], ti);
  transpose(columns[2], tj);
  for (int k = 0; k < LANES; k++) {
    if (!touching[k]) continue;
    PackedForce &on_i = forces[group.i[k]], &on_j = forces[std::min(group.j[k], own)];
    add_to(on_i.force, f[k]);
    add_to(on_i.torque, ti[k]);
    take_from(on_j.force, f[k]);
    add_to(on_j.torque, tj[k]);
  }
}

}

#endif

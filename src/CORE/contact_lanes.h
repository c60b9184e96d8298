// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_LANES_H
#define GRAINSCOPE_CONTACT_LANES_H

#include "contact_law.h"
#include "past_lanes.h"

namespace grainscope {

/** Contacts between grains, side by side, with what a Contact says of one. In lanes without a contact all of `forces`
 *  is 0, also `forces.weight`; `forces.motion` says whether all of the motion is filled in. */
struct ContactLanes {
  const PairGroup &group;
  const GroupGeometry &geometry;
  const GroupForces &forces;
  const ContactLaw &law;
  double dt;                        // the time step
  const PastLanes *past = nullptr;  // with `ledger on`

  // As in Contact and ContactMotion, k a component:
  GRAINSCOPE_INLINE Lanes branch(int k) const { return -geometry.d[k]; }
  /** The part of the force along the normal, and the rest. */
  GRAINSCOPE_INLINE Lanes normal_force() const {
    return forces.force[0] * forces.normal[0] + forces.force[1] * forces.normal[1] + forces.force[2] * forces.normal[2];
  }
  GRAINSCOPE_INLINE Lanes tangential_force(int k, const Lanes &normal_force) const {
    return forces.force[k] - normal_force * forces.normal[k];
  }
  GRAINSCOPE_INLINE Lanes slip() const {
    const Lanes slip =
        law.tangential == TangentialLaw::spring ? forces.length - forces.limit / forces.kt : forces.length * dt;
    return pick(forces.cut, slip, Lanes{});
  }
  GRAINSCOPE_INLINE Lanes normal_damping() const {
    const Lanes damping = -forces.gamma_n * forces.normal_velocity;
    if (!law.elastic || !law.limits_force) return damping;
    const Lanes elastic = forces.kn * forces.overlap;
    return pick(damping + elastic < 0.0, -elastic, damping);
  }
  /** 0 where it does not act. */
  GRAINSCOPE_INLINE Lanes tangential_damping() const {
    return law.tangential == TangentialLaw::none ? Lanes{} : pick(forces.cut, Lanes{}, forces.gamma_t);
  }
};

}

#endif

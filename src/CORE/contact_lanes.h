// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_LANES_H
#define GRAINSCOPE_CONTACT_LANES_H

#include "contact_law.h"
#include "pair_group.h"

namespace grainscope {

/** Contacts between grains, side by side, as a Contact tells them one by one. In lanes that hold none all of `forces` is 0,
 *  `forces.weight` too; `forces.motion` says whether all of it is there. */
struct ContactLanes {
  const PairGroup &group;
  const GroupGeometry &geometry;
  const GroupForces &forces;
  const ContactLaw &law;

  /** Component k of Contact::branch. */
  Lanes branch(int k) const { return -geometry.d[k]; }
};

/** The sum of all lanes, always in the same order. */
inline double sum_of(const Lanes &x) { return (x[0] + x[1]) + (x[2] + x[3]); }

}

#endif

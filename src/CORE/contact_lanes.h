// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_LANES_H
#define GRAINSCOPE_CONTACT_LANES_H

#include "contact_law.h"
#include "pair_group.h"

namespace grainscope {

/** Contacts between grains, side by side, as a Contact tells them one by one. In lanes that hold none the weight and
 *  all of `forces` are 0. */
struct ContactLanes {
  const PairGroup &group;
  const GroupGeometry &geometry;
  const GroupForces &forces;
  const ContactLaw &law;
  Lanes weight;  // as in Contact

  /** Component k of Contact::branch. */
  Lanes branch(int k) const { return -geometry.d[k]; }
};

/** The sum of all lanes, always in the same order. */
inline double sum_of(const Lanes &x) { return (x[0] + x[1]) + (x[2] + x[3]); }

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_BRANCHES_H
#define GRAINSCOPE_BRANCHES_H

#include "contact_sums.h"

namespace grainscope {

/** Branch vector: from the centre of j, or from the contact point at a wall, to the centre of i. The centre of a clump
 *  is its centre of mass. */
inline Eigen::Vector3d branch_of(const Contact &c, const Bodies &bodies) {
  if (!bodies.any()) return c.branch;
  const Eigen::Vector3d branch = c.branch - bodies.arm(c.i);
  return c.with_wall() ? branch : Eigen::Vector3d(branch + bodies.arm(c.j()));
}

/** Branches between clumps go from one centre of mass to the other. For the stress of a region the part of each branch
 *  that lies in it counts; contacts are counted where their points are. */
struct Branches {
  template <class KernelOf>
  static void add(ContactSpan contacts, const ContactCompute &of, const KernelOf &kernel_of) {
    const RegionSolid *const region = of.scope().within();
    const Bodies &bodies = of.bodies();
    if (!region && !bodies.any()) return WholeContacts::add(contacts, of, kernel_of);
    for_each_contact(contacts, of.selection().everywhere(), [&](const Contact &c) {
      const Eigen::Vector3d branch = branch_of(c, bodies);
      double share = c.weight;
      if (region) {
        const Eigen::Vector3d to = c.motion->point - c.motion->arm - bodies.arm(c.i);  // the centre of i
        share *= region->part(to - branch, to);
      }
      kernel_of(c).add_moments(c, share * branch);
      if (!region || region->has(c.motion->point)) kernel_of(c).count(c);
    });
  }
};

}

#endif

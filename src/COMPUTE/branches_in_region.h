// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_BRANCHES_IN_REGION_H
#define GRAINSCOPE_BRANCHES_IN_REGION_H

#include "contact_sums.h"

namespace grainscope {

/** Of a region's stress, the part of each branch that lies in it; contacts are counted where their points are. */
struct BranchesInRegion {
  template <class KernelOf>
  static void add(ContactSpan contacts, const ContactCompute &of, const KernelOf &kernel_of) {
    const RegionSolid *const region = of.scope().within();
    if (!region) return WholeContacts::add(contacts, of, kernel_of);
    for_each_contact(contacts, of.selection().everywhere(), [&](const Contact &c) {
      const Eigen::Vector3d to = c.motion->point - c.motion->arm;  // the centre of i
      kernel_of(c).add_moments(c, c.weight * region->part(to - c.branch, to));
      if (region->has(c.motion->point)) kernel_of(c).count(c);
    });
  }
};

}

#endif

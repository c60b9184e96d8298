// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PAIR_PLACES_H
#define GRAINSCOPE_PAIR_PLACES_H

#include "pair_group.h"

namespace grainscope {

/** Centres and radii of the bounding spheres of a group's grains. */
GRAINSCOPE_INLINE void load_places(const PackedGrains &grains, const PairGroup &group, Lanes *xi, Lanes *xj) {
  load_rows([&](int k) { return grains.grains[group.i[k]].x; }, xi);
  load_rows([&](int k) { return grains.grains[group.j[k]].x; }, xj);
}

}

#endif

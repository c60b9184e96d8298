// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_REGION_SHAPE_H
#define GRAINSCOPE_REGION_SHAPE_H

#include "solid.h"
#include <string>
#include <vector>

namespace LAMMPS_NS {
class Domain;
class Region;
}

namespace grainscope {

/** Of a union or a common part of regions of the host; no others have any. */
std::vector<LAMMPS_NS::Region *> members_of(const LAMMPS_NS::Domain &domain, LAMMPS_NS::Region *region);

/** A prism that is INF on one side only: with edges of length 1e20 LIGGGHTS loses its other bound. */
bool ends_are_unseen(LAMMPS_NS::Region *region);

/** The shape of a region at its place in the step, after its variables were asked; false and the reason where it is of
 *  a style whose shape is not known. */
bool shape_of(const LAMMPS_NS::Domain &domain, LAMMPS_NS::Region *region, Solid &solid, std::string &why);

/** Whether it is a block that does not move, not turned inside out; between which corners, infinite ones beyond
 * 1e19. */
bool is_standing_block(LAMMPS_NS::Region *region, Eigen::Vector3d &low, Eigen::Vector3d &high);

}

#endif

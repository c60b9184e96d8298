// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_WALL_REACH_H
#define GRAINSCOPE_WALL_REACH_H

#include "box_state.h"
#include "fix_wall_gran_insitu.h"
#include <array>
#include <string>
#include <vector>

namespace grainscope {

/** Whether a primitive wall is a plane, or else a cylinder. */
bool is_plane(const std::vector<std::string> &primitive);

/** Between which coordinates a wall lies. */
struct WallReach {
  std::array<double, 3> low, high;

  /** Collective. */
  static WallReach of(const Wall &wall, MPI_Comm world);
  /** The part in the box. */
  WallReach in(const BoxState &box) const;
};

/** The names of walls that end a plane, a cylinder or a flat mesh inside the box, so that grains may press on a part of
 *  it only. Meshes are looked at by their ends along the axes. Collective. */
std::string walls_that_bound(const Wall &wall, const BoxState &box, LAMMPS_NS::LAMMPS *lmp);

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_OBSERVED_WALL_H
#define GRAINSCOPE_OBSERVED_WALL_H

#include "contact_reader.h"
#include "time_level.h"
#include "granular_wall.h"
#include "tri_mesh.h"
#include <algorithm>
#include <cstdint>
#include <vector>

namespace grainscope {

/** Connects a fix wall/gran and the contact model that it runs. */
struct WallContacts {
  ContactReader *reader = nullptr;                        // while contacts are to be read; else null
  TimeLevel *level = nullptr;                             // with `time_level synchronized`; else null
  PartnerWall first;                                      // the wall, or that of the first mesh
  std::vector<const LAMMPS_NS::FixMeshSurface *> meshes;  // in order; none of a primitive wall
  double exponent = 0.0;  // of the elastic normal force; known to the model alone, which sets it

  /** Which wall a contact is with; its velocity is left at zero. */
  PartnerWall partner(const ContactReader::Surfaces &s) const {
    PartnerWall wall = first;
    if (meshes.empty()) return wall;
    wall.wall += static_cast<int>(std::find(meshes.begin(), meshes.end(), s.fix_mesh) - meshes.begin());
    wall.triangle = s.mesh->id(s.j);
    return wall;
  }
};

/** The wall of LIGGGHTS for the contact-model combination `hash`, with an observer around its model: compiled for every
 *  combination of the whitelist; all others use the dynamic model of LIGGGHTS. It offers contacts if `wall` is a
 *  WallContactsOwner. */
LIGGGHTS::Walls::IGranularWall *create_observed_wall(int64_t hash, LAMMPS_NS::LAMMPS *lmp,
                                                     LAMMPS_NS::FixWallGran *wall);
/** The combinations that are compiled, and the one that the host's dynamic path goes by. */
std::vector<int64_t> observed_walls();

}

#endif

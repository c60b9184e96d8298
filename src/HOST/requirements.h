// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_REQUIREMENTS_H
#define GRAINSCOPE_REQUIREMENTS_H

#include "arguments.h"
#include "atom.h"
#include "domain.h"
#include "lammps.h"
#include "two_dimensions.h"

namespace grainscope {

/** Errors unless grains have a radius or semi-axes, and spins; with `dimension 2` a radius. In the constructor, once
 *  the words are read, and in init(): before there is a box the atom style may change. */
inline void require_grains(LAMMPS_NS::LAMMPS *lmp, const Arguments &errors) {
  if (!lmp->atom->superquadric_flag && !lmp->atom->sphere_flag)
    errors.fail("needs atom_style superquadric or sphere, got '" + std::string(lmp->atom->atom_style) + "'");
  require_grains_of_dimension(lmp, errors);
}

/** Errors unless there is a box: LIGGGHTS makes no fix before, and the memory of grains is a fix. */
inline void require_box(LAMMPS_NS::LAMMPS *lmp, const Arguments &errors) {
  if (!lmp->domain->box_exist) errors.fail("keeps data of each grain: define it after the simulation box");
}

}

#endif

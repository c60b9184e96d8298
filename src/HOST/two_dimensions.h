// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_TWO_DIMENSIONS_H
#define GRAINSCOPE_TWO_DIMENSIONS_H

#include "arguments.h"

// Without the host's headers: the fuzzer takes what reads words alone.
namespace grainscope {

/** Errors with `dimension 2` where a word that names axes names z: nothing varies along it there. */
void require_axes_of_plane(LAMMPS_NS::LAMMPS *lmp, const Arguments &errors, const std::string &keyword,
                           const std::string &choices, const std::string &got);

/** Errors with `dimension 2` and atom_style superquadric: LIGGGHTS makes no such grains there, and a disc is a
 *  sphere. */
void require_grains_of_dimension(LAMMPS_NS::LAMMPS *lmp, const Arguments &errors);

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_GRAIN_STATE_H
#define GRAINSCOPE_GRAIN_STATE_H

#include "lmptype.h"
#include <cstdint>
#include <string>

namespace LAMMPS_NS {
class Atom;
}

namespace grainscope {

/** Checksums by which a change of a grain is noticed: of its velocity, which wrapping may change, and of its spin,
 *  orientation, shape, mass and type, which nothing but a command changes between runs. Whole numbers. */
double velocity_hash(const LAMMPS_NS::Atom *atom, int i);
double state_hash(const LAMMPS_NS::Atom *atom, int i);

/** A checksum of words. */
std::uint64_t text_hash(const std::string &text);

/** How many box edges a grain was wrapped by, positive downward, when its image flag changed. */
void edges_crossed(LAMMPS_NS::tagint before, LAMMPS_NS::tagint after, int edges[3]);

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_OBSERVED_WALL_H
#define GRAINSCOPE_OBSERVED_WALL_H

#include "contact_reader.h"
#include "granular_wall.h"
#include <cstdint>
#include <vector>

namespace grainscope {

/** What a fix wall/gran shows of itself to the contact model that it runs. */
class WallContacts {
 public:
  virtual ~WallContacts() = default;
  /** Null where nobody observes: no pair_style gran/insitu. */
  virtual ContactReader *reader() = 0;
  /** Which wall this is; its velocity is left at zero. */
  virtual PartnerWall partner(const ContactReader::Surfaces &s) const = 0;
  /** The exponent of the elastic normal force, known to the model alone. */
  virtual void set_exponent(double exponent) = 0;
};

/** The host's wall for the contact-model combination `hash`, with an observer around its model: compiled for every
 *  combination of the whitelist, the host's dynamic path for all others. It shows contacts where `wall` is a
 *  WallContactsOwner. */
LIGGGHTS::Walls::IGranularWall *create_observed_wall(int64_t hash, LAMMPS_NS::LAMMPS *lmp,
                                                     LAMMPS_NS::FixWallGran *wall);
/** The combinations that are compiled, and the one that the host's dynamic path goes by. */
std::vector<int64_t> observed_walls();

}

#endif

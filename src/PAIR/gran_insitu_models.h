// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_GRAN_INSITU_MODELS_H
#define GRAINSCOPE_GRAN_INSITU_MODELS_H

#include "granular_pair_style.h"

namespace grainscope {

/** A loop that resets the spring of a contact when it opens; the loop of LIGGGHTS may keep it until the next neighbour
 *  list. */
struct ResetsOpenedSprings {
  virtual ~ResetsOpenedSprings() {}
  /** Whether it does so for the grains of this run: other grains are left to the loop of LIGGGHTS. */
  virtual bool resets_springs() const = 0;
};

/** The observed pair loop for the contact-model combination `hash`: compiled for every combination of the whitelist;
 *  all others use the dynamic model of LIGGGHTS. */
LIGGGHTS::PairStyles::IGranularPairStyle *create_observed_loop(int64_t hash, LAMMPS_NS::LAMMPS *lmp,
                                                               LAMMPS_NS::PairGran *pair);

}

#endif

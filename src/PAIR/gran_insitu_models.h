// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_GRAN_INSITU_MODELS_H
#define GRAINSCOPE_GRAN_INSITU_MODELS_H

#include "granular_pair_style.h"

namespace grainscope {

/** A loop of ours that resets the spring of a contact when it opens; the host's may keep it until the next neighbour
 *  list. */
struct ResetsOpenedSprings {
  virtual ~ResetsOpenedSprings() {}
  /** Of the grains that there are: others are left to the host's loop. */
  virtual bool resets_springs() const = 0;
};

/** The observed pair loop for the contact-model combination `hash`: compiled for every combination of the whitelist,
 *  the host's dynamic path for all others. */
LIGGGHTS::PairStyles::IGranularPairStyle *create_observed_loop(int64_t hash, LAMMPS_NS::LAMMPS *lmp,
                                                               LAMMPS_NS::PairGran *pair);

}

#endif

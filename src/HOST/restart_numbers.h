// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_RESTART_NUMBERS_H
#define GRAINSCOPE_RESTART_NUMBERS_H

#include "bin_index.h"
#include "atom.h"

namespace grainscope {

/** The `count` numbers that a restart file holds of grain i for the nth of the fixes that store such; null when there
 *  are not so many. Each fix's are preceded by how many there are, with this one. */
inline const double *restart_numbers(const LAMMPS_NS::Atom *atom, int i, int nth, int count) {
  const double *at = atom->extra[i], *const end = at + atom->nextra_store;
  for (int k = 0; k < nth && at < end; k++) {
    const long long own = whole_count(at[0], atom->nextra_store);
    if (own < 1) return nullptr;
    at += own;
  }
  return end - at > count && at[0] == count + 1 ? at + 1 : nullptr;
}

}

#endif

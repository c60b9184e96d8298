// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_ids.h"
#include "atom.h"
#include "fix_contact_history.h"
#include "lammps.h"
#include "modify.h"
#include <mpi.h>

using LAMMPS_NS::FixContactHistory;

namespace grainscope {

namespace {

bool knows(FixContactHistory *history, int i, int id) {
  for (int k = 0; k < history->n_partner(i); k++)
    if (history->partner(i, k) == id) return true;
  return false;
}

}

bool contacts_know_their_grains(LAMMPS_NS::LAMMPS *lmp) {
  LAMMPS_NS::Atom *atom = lmp->atom;
  const bool kept = lmp->modify->n_fixes_style_strict("contacthistory") > 0 && atom->map_style;
  auto *history =
      kept ? dynamic_cast<FixContactHistory *>(lmp->modify->find_fix_style_strict("contacthistory", 0)) : nullptr;
  int one_sided = 0;
  for (int i = 0; history && i < atom->nlocal; i++)
    for (int k = 0; k < history->n_partner(i); k++) {
      const int j = atom->map(history->partner(i, k));
      if (j >= 0 && j < atom->nlocal && !knows(history, j, atom->tag[i])) one_sided = 1;
    }
  MPI_Allreduce(MPI_IN_PLACE, &one_sided, 1, MPI_INT, MPI_MAX, lmp->world);
  return !one_sided;
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "ledger_requirements.h"
#include "contact_law.h"
#include "fix_wall_gran_insitu.h"
#include "pair_gran_insitu.h"
#include "atom.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "fix_adapt.h"
#include "group.h"
#include "modify.h"
#include <cstdlib>
#include <cstring>
#include <initializer_list>

namespace grainscope {

using LAMMPS_NS::Fix;
using LAMMPS_NS::PairGranInsitu;

namespace {

bool one_of(const char *style, std::initializer_list<const char *> styles) {
  for (const char *one : styles)
    if (!strcmp(style, one)) return true;
  return false;
}

}

void LedgerRequirements::fail(const std::string &message) const {
  error->all(FLERR, (who_ + ": " + message).c_str());
  std::abort();  // not reached: error->all ends the run
}

void LedgerRequirements::require_known_contacts(PairGranInsitu &pair) const {
  const ContactLaw &law = pair.law();
  if (!law.keeps_past())
    fail("needs 'ledger on' in pair_style gran/insitu, which keeps the energy stored in each contact, got '" +
         pair.models() + "'");
  if (!law.why_no_energy().empty()) fail(law.why_no_energy());
  if (pair.renumbered())
    fail("grains got new IDs, and the contact history is kept by ID: use 'delete_atoms ... compress no'");
}

std::vector<const ContactLaw *> LedgerRequirements::require_known_walls() const {
  std::vector<const ContactLaw *> laws;
  for (const Wall &wall : walls_of(lmp)) {
    const std::string why = wall.law->why_no_energy();
    if (!why.empty()) fail("wall '" + wall.name + "': " + why);
    laws.push_back(wall.law);
  }
  return laws;
}

/** Whether some grain belongs to the ledger's group and to another. Collective. */
bool LedgerRequirements::shares_grains(int other_groupbit) const {
  int any = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & groupbit_) && (atom->mask[i] & other_groupbit)) any = 1;
  MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, world);
  return any;
}

/** Kinetic energy is booked as velocity Verlet changes it: every grain of the group must be moved by one such fix, or
 *  not at all (frozen). */
LedgerRequirements::Movers LedgerRequirements::require_moved_by_verlet() const {
  Movers movers;
  for (int k = 0; k < modify->nfix; k++) {
    const Fix *fix = modify->fix[k];
    const auto *adapt = dynamic_cast<const LAMMPS_NS::FixAdapt *>(fix);
    if (adapt && adapt->diamflag && shares_grains(fix->groupbit))
      fail(std::string("needs grains whose diameters do not change within a run, got fix ") + fix->id + " of style " +
           fix->style + " with 'diameter'");
    if (one_of(fix->style, {"nve/sphere", "nve/superquadric", "nve/spheroid"})) {
      movers.moved |= fix->groupbit;
    } else if (!strcmp(fix->style, "freeze")) {
      movers.frozen |= fix->groupbit;
    } else if (fix->time_integrate || fix->rigid_flag || strstr(fix->style, "multisphere") ||
               !strcmp(fix->style, "move")) {
      if (shares_grains(fix->groupbit))
        fail(std::string("needs grains that are moved by fix nve/sphere, nve/superquadric or nve/spheroid, or frozen, "
                         "got fix ") +
             fix->id + " of style " + fix->style);
    }
  }
  int loose = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & groupbit_) && !(atom->mask[i] & (movers.moved | movers.frozen))) loose++;
  MPI_Allreduce(MPI_IN_PLACE, &loose, 1, MPI_INT, MPI_SUM, world);
  if (loose)
    fail("every grain of the group must be moved by fix nve/sphere, nve/superquadric or nve/spheroid, or be frozen, "
         "got " +
         std::to_string(loose) + " that are not");
  return movers;
}

void LedgerRequirements::require_flowing_box() const {
  for (int k = 0; k < modify->nfix; k++) {
    const Fix *fix = modify->fix[k];
    if (!fix->box_change_size && !fix->box_change_shape) continue;
    const std::string which = std::string("fix ") + fix->id + " (" + fix->style + ")";
    if (!domain->deform_vremap) fail("needs 'remap v' where the box deforms, got " + which + " without it");
    if (domain->deform_groupbit != 1)
      fail("needs a box that deforms for the group all, got " + which + " for the group " + group->names[fix->igroup]);
  }
}

}

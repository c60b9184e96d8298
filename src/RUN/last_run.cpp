// SPDX-License-Identifier: GPL-2.0-or-later
#include "last_run.h"
#include "grain_memory.h"
#include "grain_state.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "fix.h"
#include "modify.h"
#include "update.h"
#include <algorithm>
#include <string>

namespace grainscope {

using LAMMPS_NS::Fix;
using LAMMPS_NS::LAMMPS;

namespace {

/** Old forces are not valid if a fix that adds to them comes or goes. The order does not matter: that of an input
 *  script after read_restart may differ. */
double checksum_of_moving_fixes(const LAMMPS *lmp) {
  double sum = 0.0;
  for (int k = 0; k < lmp->modify->nfix; k++) {
    const Fix *fix = lmp->modify->fix[k];
    if (!(lmp->modify->fmask[k] & LAMMPS_NS::FixConst::POST_FORCE) && !fix->time_integrate) continue;
    sum += text_hash(std::string(fix->id) + ' ' + fix->style) % 1000003 + fix->groupbit;
  }
  return sum;
}

}

LastRun LastRun::ending_now(LAMMPS *lmp) {
  LastRun run;
  run.box = HostBox::of(lmp->domain);
  run.grains = lmp->atom->natoms;
  run.time_step = lmp->update->dt;
  run.steps_to_sorting = lmp->atom->nextsort - lmp->update->ntimestep;
  run.moving_fixes = checksum_of_moving_fixes(lmp);
  return run;
}

/** Whether images are where they were. A face that is not periodic exerts no force, wherever it is: a shrink-wrapped
 *  face is set again when the run begins. */
bool LastRun::same_box(const LAMMPS *lmp) const {
  const LAMMPS_NS::Domain *domain = lmp->domain;
  const HostBox now = HostBox::of(domain);
  const int periodic[3] = {domain->xperiodic, domain->yperiodic, domain->zperiodic};
  for (int k = 0; k < 3; k++)
    if (periodic[k] && (now.low[k] != box.low[k] || now.high[k] != box.high[k])) return false;
  return std::equal(now.tilts, now.tilts + 3, box.tilts);
}

bool LastRun::goes_on(LAMMPS *lmp, const GrainMemory &memory) const {
  int changed = grains != static_cast<double>(lmp->atom->natoms) || time_step != lmp->update->dt ||
                moving_fixes != checksum_of_moving_fixes(lmp) || !same_box(lmp);
  for (int i = 0; i < lmp->atom->nlocal && !changed; i++) changed = !memory.unchanged(i);
  MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_MAX, lmp->world);
  if (changed && !there_was_none() && lmp->comm->me == 0)
    for (FILE *out : {lmp->screen, lmp->logfile})
      if (out)
        fprintf(out, "pair_style gran/insitu: grains, box, time step or fixes were changed since the last run: "
                     "forces are recomputed with full-step velocities, within the friction limit\n");
  return !changed;
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_nve_spheroid.h"
#include "arguments.h"
#include "two_dimensions.h"
#include "atom.h"
#include "error.h"
#include "modify.h"
#include "spheroid_motion.h"
#include "spheroid_rotation.h"
#include <algorithm>
#include <climits>
#include <cstring>
#include <sstream>
#include <string>

using namespace LAMMPS_NS;

FixNVESpheroid::FixNVESpheroid(LAMMPS *lmp, int narg, char **arg) : FixNVE(lmp, narg, arg) {
  grainscope::Arguments arguments(lmp, "fix nve/spheroid", 3, narg, arg);
  arguments.require_none();
  if (!atom->superquadric_flag)
    arguments.fail("needs atom_style superquadric, got '" + std::string(atom->atom_style) + "'");
  grainscope::require_grains_of_dimension(lmp, arguments);
}

int FixNVESpheroid::setmask() { return FixNVE::setmask() | FixConst::PRE_NEIGHBOR; }

void FixNVESpheroid::init() {
  FixNVE::init();
  for (int k = 0; k < modify->nfix; k++) {
    if (strcmp(modify->fix[k]->style, "couple/cfd/force/implicit") != 0) continue;
    const std::string coupling = std::string("fix ") + modify->fix[k]->id + " (couple/cfd/force/implicit)";
    error->all(
        FLERR,
        ("fix nve/spheroid: " + coupling +
         " leaves its torque to the integrator, and fix nve/spheroid does not apply it: use fix nve/superquadric")
            .c_str());
  }
}

int FixNVESpheroid::grains() const { return igroup == atom->firstgroup ? atom->nfirst : atom->nlocal; }

/** Checked with every neighbour list, and so whenever grains were inserted. Collective: every rank names the same
 *  grain. */
void FixNVESpheroid::require_symmetric_tops() const {
  int first = INT_MAX, at = 0;
  const int n = grains();
  for (int i = 0; i < n; i++)
    if ((atom->mask[i] & groupbit) && atom->tag[i] < first && !grainscope::is_symmetric_top(atom->inertia[i]))
      first = atom->tag[at = i];
  const int mine = first;
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, world);
  if (first == INT_MAX) return;

  double shape[5] = {0.0, 0.0, 0.0, 0.0, 0.0};
  if (mine == first) {
    std::copy(atom->shape[at], atom->shape[at] + 3, shape);
    std::copy(atom->blockiness[at], atom->blockiness[at] + 2, shape + 3);
  }
  MPI_Allreduce(MPI_IN_PLACE, shape, 5, MPI_DOUBLE, MPI_SUM, world);
  std::ostringstream message;
  message << "fix nve/spheroid: grain " << first << " has three different moments of inertia (semi-axes " << shape[0]
          << " " << shape[1] << " " << shape[2] << ", blockiness " << shape[3] << " " << shape[4]
          << "): use fix nve/superquadric";
  error->all(FLERR, message.str().c_str());
}

grainscope::Spheroids FixNVESpheroid::spheroids() const {
  const auto rows = [](double **array) { return array ? array[0] : nullptr; };  // none where there never was a grain
  return {
      grains(),           groupbit,      atom->mask,    atom->rmass,        rows(atom->inertia),    rows(atom->f),
      rows(atom->torque), rows(atom->x), rows(atom->v), rows(atom->angmom), rows(atom->quaternion), rows(atom->omega)};
}

void FixNVESpheroid::initial_integrate(int) { grainscope::kick_and_drift(spheroids(), dtf, dtv); }

void FixNVESpheroid::final_integrate() { grainscope::kick(spheroids(), dtf); }

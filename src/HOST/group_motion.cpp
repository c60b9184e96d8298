// SPDX-License-Identifier: GPL-2.0-or-later
#include "group_motion.h"
#include "atom.h"
#include "lammps.h"
#include <mpi.h>

namespace grainscope {

using Eigen::Map;
using Eigen::Vector3d;

double mass_of(LAMMPS_NS::LAMMPS *lmp, int i) {
  return lmp->atom->rmass ? lmp->atom->rmass[i] : lmp->atom->mass[lmp->atom->type[i]];
}

GroupMotion::GroupMotion(LAMMPS_NS::LAMMPS *lmp, int groupbit, const BoxState &box) {
  const LAMMPS_NS::Atom *atom = lmp->atom;
  double sums[5] = {0.0, 0.0, 0.0, 0.0, 0.0};
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double m = mass_of(lmp, i);
    const Vector3d momentum = m * (Map<const Vector3d>(atom->v[i]) - box.flow(Map<const Vector3d>(atom->x[i])));
    for (int k = 0; k < 3; k++) sums[k] += momentum[k];
    sums[3] += m;
    sums[4] += 1.0;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 5, MPI_DOUBLE, MPI_SUM, lmp->world);
  mass = sums[3];
  grains = sums[4];
  if (mass > 0.0) drift = Map<const Vector3d>(sums) / mass;
}

Eigen::Matrix3d peculiar_momentum_flux(LAMMPS_NS::LAMMPS *lmp, int groupbit, const BoxState &box, const GroupMotion &motion) {
  const LAMMPS_NS::Atom *atom = lmp->atom;
  Eigen::Matrix3d flux = Eigen::Matrix3d::Zero();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const Vector3d dv = Map<const Vector3d>(atom->v[i]) - box.flow(Map<const Vector3d>(atom->x[i])) - motion.drift;
    flux += mass_of(lmp, i) * dv * dv.transpose();
  }
  MPI_Allreduce(MPI_IN_PLACE, flux.data(), 9, MPI_DOUBLE, MPI_SUM, lmp->world);
  return flux;
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "peculiar_motion.h"
#include "atom.h"
#include "lammps.h"
#include <mpi.h>

namespace grainscope {

using Eigen::Map;
using Eigen::Vector3d;

PeculiarMotion::PeculiarMotion(LAMMPS_NS::LAMMPS *lmp, int groupbit, const BoxState &box) : lmp_(lmp) {
  const LAMMPS_NS::Atom *atom = lmp->atom;
  local_.resize(atom->nlocal);
  Grain *grain = local_.data();
  const BoxState flow = box;
  double mass = 0.0;
  Vector3d momentum = Vector3d::Zero();
  for (int i = 0, n = atom->nlocal; i < n; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double m = atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
    const Vector3d u = Map<const Vector3d>(atom->v[i]) - flow.flow(Map<const Vector3d>(atom->x[i]));
    *grain++ = {m, u};
    momentum += m * u;
    mass += m;
  }
  local_.resize(grain - local_.data());
  double sums[5] = {momentum[0], momentum[1], momentum[2], mass, static_cast<double>(local_.size())};
  MPI_Allreduce(MPI_IN_PLACE, sums, 5, MPI_DOUBLE, MPI_SUM, lmp->world);
  grains_ = sums[4];
  drift_ = sums[3] > 0.0 ? Vector3d(Map<const Vector3d>(sums) / sums[3]) : Vector3d::Zero();
}

Eigen::Matrix3d PeculiarMotion::momentum_flux() const {
  double sums[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  for (const Grain &grain : local_) {
    const Vector3d dv = grain.u - drift_, p = grain.mass * dv;
    sums[0] += p[0] * dv[0];
    sums[1] += p[1] * dv[1];
    sums[2] += p[2] * dv[2];
    sums[3] += p[0] * dv[1];
    sums[4] += p[0] * dv[2];
    sums[5] += p[1] * dv[2];
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 6, MPI_DOUBLE, MPI_SUM, lmp_->world);
  Eigen::Matrix3d flux;
  flux << sums[0], sums[3], sums[4], sums[3], sums[1], sums[5], sums[4], sums[5], sums[2];
  return flux;
}

}

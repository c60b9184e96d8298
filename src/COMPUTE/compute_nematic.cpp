// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_nematic.h"
#include "arguments.h"
#include "grain_shape.h"
#include "nematic.h"
#include "requirements.h"
#include "symmetric_tensor.h"
#include "atom.h"
#include "update.h"

using namespace LAMMPS_NS;
using Eigen::Vector3d;

ComputeNematic::ComputeNematic(LAMMPS *lmp, int &iarg, int narg, char **arg) : Compute(lmp, iarg, narg, arg) {
  grainscope::Arguments arguments(lmp, "compute nematic", iarg, narg, arg);
  arguments.require_none();
  grainscope::require_grains(lmp, arguments);
  scalar_flag = vector_flag = 1;
  extscalar = 0;
  extvector = 0;
  size_vector = 20;
  vector = new double[size_vector]();
}

ComputeNematic::~ComputeNematic() { delete[] vector; }

void ComputeNematic::init() { grainscope::require_grains(lmp, grainscope::Arguments(lmp, "compute nematic")); }

void ComputeNematic::compute_vector() {
  invoked_vector = update->ntimestep;
  grainscope::NematicSums sums;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    sums.add_spin(Eigen::Map<const Vector3d>(atom->omega[i]));
    if (!atom->superquadric_flag) continue;
    const grainscope::SymmetryAxis axis = grainscope::symmetry_axis(atom->shape[i]);
    if (axis.shape == grainscope::Shape::sphere) continue;
    sums.add_axis(grainscope::orientation(*atom, i) * Vector3d::Unit(axis.index), axis.shape);
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.sums.data(), sums.sums.size(), MPI_DOUBLE, MPI_SUM, world);

  const grainscope::Nematic nematic(sums);
  double *out = grainscope::write_components(nematic.q, vector);
  for (double value : {nematic.director[0], nematic.director[1], nematic.director[2], nematic.biaxiality, nematic.theta,
                       nematic.director_theta, nematic.spin[0], nematic.spin[1], nematic.spin[2], nematic.grains_with_axis,
                       nematic.grains_with_theta, nematic.eigenvalues[0], nematic.eigenvalues[1], nematic.eigenvalues[2]})
    *out++ = value;
  scalar = nematic.order;
}

double ComputeNematic::compute_scalar() {
  invoked_scalar = update->ntimestep;
  if (invoked_vector != update->ntimestep) compute_vector();
  return scalar;
}

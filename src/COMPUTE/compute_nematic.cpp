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

namespace {

constexpr auto intensive = grainscope::Extent::intensive, whole = grainscope::Extent::whole;

grainscope::Outputs declared() {
  grainscope::Outputs outputs;
  outputs.scalar = {{"S2", "-", intensive, "nematic order, 3/2 of the largest eigenvalue of Q"}};
  outputs.vector.add_each("xx yy zz xy xz yz", {"Q*", "-", intensive, "order tensor Q_*"})
      .add_each("x y z", {"director_*", "-", intensive, "* of the director"})
      .add({"biaxiality", "-", intensive, "middle less smallest eigenvalue of Q"})
      .add({"theta", "rad", intensive, "mean angle theta_x of the major axes to x in the xy plane"})
      .add({"theta_director", "rad", intensive, "theta_x of the director"})
      .add_each("x y z", {"omega_*", "1/time", intensive, "mean angular velocity *"})
      .add({"N_axis", "-", whole, "grains with an axis"})
      .add({"N_theta", "-", whole, "grains counted in theta"})
      .add_each("1 2 3", {"eigenvalue_*", "-", intensive, "eigenvalue * of Q, descending"});
  return outputs;
}

}

ComputeNematic::ComputeNematic(LAMMPS *lmp, int &iarg, int narg, char **arg) : Compute(lmp, iarg, narg, arg) {
  grainscope::Arguments arguments(lmp, "compute nematic", iarg, narg, arg);
  arguments.require_none();
  grainscope::require_grains(lmp, arguments);
  declare(this, declared());
}

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
  for (double value :
       {nematic.director[0], nematic.director[1], nematic.director[2], nematic.biaxiality, nematic.theta,
        nematic.director_theta, nematic.spin[0], nematic.spin[1], nematic.spin[2], nematic.grains_with_axis,
        nematic.grains_with_theta, nematic.eigenvalues[0], nematic.eigenvalues[1], nematic.eigenvalues[2]})
    *out++ = value;
  require_all_elements(out);
  scalar = nematic.order;
}

double ComputeNematic::compute_scalar() {
  invoked_scalar = update->ntimestep;
  if (invoked_vector != update->ntimestep) compute_vector();
  return scalar;
}

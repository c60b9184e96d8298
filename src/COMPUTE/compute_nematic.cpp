// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_nematic.h"
#include "arguments.h"
#include "atom.h"
#include "nematic.h"
#include "surroundings.h"
#include "update.h"
#include <Eigen/Geometry>

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

void ComputeNematic::init() { grainscope::require_grains(lmp, grainscope::Arguments(lmp, "compute nematic", 0, 0, nullptr)); }

void ComputeNematic::compute_vector() {
  invoked_vector = update->ntimestep;
  grainscope::NematicSums sums;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    sums.add_spin(Eigen::Map<const Vector3d>(atom->omega[i]));
    if (!atom->superquadric_flag) continue;
    const grainscope::SymmetryAxis axis = grainscope::symmetry_axis(atom->shape[i]);
    if (axis.shape == grainscope::Shape::sphere) continue;
    const double *q = atom->quaternion[i];
    sums.add_axis(Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * Vector3d::Unit(axis.index), axis.shape);
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.sums.data(), sums.sums.size(), MPI_DOUBLE, MPI_SUM, world);

  const grainscope::Nematic nematic(sums);
  const Eigen::Matrix3d &m = nematic.q;
  const auto &axis = nematic.director, &spin = nematic.spin, &eigenvalue = nematic.eigenvalues;
  put_vector({m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2), axis[0], axis[1], axis[2], nematic.biaxiality,
              nematic.theta, nematic.director_theta, spin[0], spin[1], spin[2], nematic.grains_with_axis,
              nematic.grains_with_theta, eigenvalue[0], eigenvalue[1], eigenvalue[2]});
  scalar = nematic.order;
}

double ComputeNematic::compute_scalar() {
  invoked_scalar = update->ntimestep;
  if (invoked_vector != update->ntimestep) compute_vector();
  return scalar;
}

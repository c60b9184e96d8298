// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_nematic.h"
#include "arguments.h"
#include "bodies.h"
#include "chosen_axis.h"
#include "nematic.h"
#include "scope.h"
#include "requirements.h"
#include "symmetric_tensor.h"
#include "atom.h"
#include "comm.h"
#include "error.h"
#include "group.h"
#include "update.h"
#include <algorithm>

using namespace LAMMPS_NS;
using Eigen::Vector3d;

namespace {

using grainscope::AxisChoice;
using grainscope::Scope;
using grainscope::Shape;
using grainscope::SymmetryAxis;

constexpr auto intensive = grainscope::Extent::intensive, whole = grainscope::Extent::whole;

grainscope::Outputs declared() {
  grainscope::Outputs outputs;
  outputs.scalar = {{"S2", "-", intensive, "nematic order, 3/2 of the largest eigenvalue of Q"}};
  outputs.vector.add_each("xx yy zz xy xz yz", {"Q*", "-", intensive, "order tensor Q_*"})
      .add_each("x y z", {"director_*", "-", intensive, "* of the director"})
      .add({"biaxiality", "-", intensive, "middle less smallest eigenvalue of Q"})
      .add({"theta", "rad", intensive, "mean angle of the major axes to the flow in the plane, theta_x by default"})
      .add({"theta_director", "rad", intensive, "the same angle of the director"})
      .add_each("x y z", {"omega_*", "1/time", intensive, "mean angular velocity *"})
      .add({"N_axis", "-", whole, "grains with an axis"})
      .add({"N_theta", "-", whole, "grains counted in theta"})
      .add_each("1 2 3", {"eigenvalue_*", "-", intensive, "eigenvalue * of Q, descending"});
  return outputs;
}

}

struct ComputeNematic::Impl {
  explicit Impl(LAMMPS *lmp) : scope(lmp, "compute nematic", Scope::region | Scope::plane | Scope::axis) {}
  Scope scope;
  grainscope::MixtureWarning mixture;
};

ComputeNematic::ComputeNematic(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : Compute(lmp, iarg, narg, arg), impl_(new Impl(lmp)) {
  grainscope::Arguments arguments(lmp, "compute nematic", iarg, narg, arg);
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword(impl_->scope.with({}));
    impl_->scope.read(arguments, keyword);
  }
  grainscope::require_grains(lmp, arguments);
  declare(this, declared());
}

ComputeNematic::~ComputeNematic() {}

void ComputeNematic::init() {
  grainscope::require_grains(lmp, grainscope::Arguments(lmp, "compute nematic"));
  grainscope::require_no_bodies(lmp, grainscope::Arguments(lmp, "compute nematic"), "they have no axis of symmetry");
  impl_->scope.init();
}

void ComputeNematic::compute_vector() {
  invoked_vector = update->ntimestep;
  impl_->scope.update(grainscope::BoxState(lmp));
  grainscope::NematicSums sums(impl_->scope.shear_plane().flow, impl_->scope.shear_plane().gradient);
  const auto counts = [this](int i) {
    return (atom->mask[i] & groupbit) && impl_->scope.has_place(Eigen::Map<const Vector3d>(atom->x[i]));
  };
  constexpr int all = 1;
  const bool counts_all = groupbit == all && !impl_->scope.within();
  for (int i = 0, n = 0; i < atom->nlocal; i += n) {
    n = 1;
    if (!counts_all && !counts(i)) continue;
    const bool spheres = !atom->superquadric_flag;
    if (counts_all) n = spheres ? atom->nlocal : grainscope::NematicSums::alike(atom->nlocal - i, atom->shape[i]);
    SymmetryAxis axis{Shape::sphere, -1};
    if (!spheres) axis = grainscope::chosen_axis(atom->shape[i], impl_->scope.axis_choice());
    sums.add_alike(n, axis, spheres ? nullptr : atom->quaternion[i], atom->omega[i]);
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.sums.data(), sums.sums.size(), MPI_DOUBLE, MPI_SUM, world);

  const grainscope::Nematic nematic(sums);
  if (impl_->scope.axis_is_automatic())
    impl_->mixture.warn(lmp, "compute nematic", group->names[igroup], sums.oblate(), nematic.grains_with_axis);
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

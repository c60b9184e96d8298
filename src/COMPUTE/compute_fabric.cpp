// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_fabric.h"
#include "arguments.h"
#include "fabric.h"
#include "plane.h"
#include "principal_axes.h"
#include "update.h"
#include <algorithm>
#include <cmath>
#include <vector>

using namespace LAMMPS_NS;
using Eigen::Matrix3d;
using grainscope::Contact;
using grainscope::WeightedFabricSums;

namespace {

struct Weighted {
  const char *name, *output;  // the keyword, and how outputs begin
  Matrix3d (WeightedFabricSums::*tensor)() const;
};

const Weighted weighted_tensors[] = {{"branch", "branch", &WeightedFabricSums::branch},
                                     {"force/normal", "force_normal", &WeightedFabricSums::normal_force},
                                     {"force/tangential", "force_tangential", &WeightedFabricSums::tangential_force}};

const double rounding = 1e-10;  // of sums whose trace is 1
constexpr auto intensive = grainscope::Extent::intensive, whole = grainscope::Extent::whole;
const char *const six = "xx yy zz xy xz yz";

grainscope::Outputs declared(const std::vector<const Weighted *> &chosen) {
  grainscope::Outputs outputs;
  outputs.vector.add_each(six, {"F_*", "-", intensive, "fabric, mean of n_a n_b"})
      .add_each("1 2 3", {"eigenvalue_*", "-", intensive, "eigenvalue * of the fabric, descending"});
  for (const char *axis : {"1", "2", "3"})
    outputs.vector.add_each("x y z", {std::string("eigenvector_") + axis + "_*", "-", intensive,
                                      std::string("* of eigenvector ") + axis});
  const grainscope::NamedOutput deviator = {"deviator", "-", intensive, "sqrt(3/2 F':F')"};
  outputs.vector.add(deviator)
      .add({"angle", "rad", intensive, "principal angle in the plane"})
      .add({"ratio", "-", intensive, "anisotropy, eigenvalue_1 over eigenvalue_2"})
      .add({"N_c", "-", whole, "contacts"});
  for (const Weighted *one : chosen)
    outputs.vector.add_each(
        six, {std::string(one->output) + "_*", "-", intensive, std::string(one->name) + " tensor, *"});
  outputs.scalar = {deviator};
  return outputs;
}

double *put_symmetric(double *at, const Matrix3d &m) {
  for (double value : {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)}) *at++ = value;
  return at;
}

}

struct ComputeFabric::Impl {
  grainscope::Plane plane;
  std::vector<const Weighted *> chosen;
  grainscope::FabricSums sums;
  // The weights depend on the fabric of all contacts: the weighted tensors, when asked for, need a second pass.
  std::vector<grainscope::ContactMoment> moments;
};

ComputeFabric::ComputeFabric(LAMMPS *lmp, int &iarg, int narg, char **arg) : ContactCompute(lmp, iarg, narg, arg), impl_(new Impl) {
  grainscope::Arguments arguments(lmp, name_, iarg, narg, arg);
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword({"plane", "branch", "force/normal", "force/tangential"});
    if (keyword == "plane") impl_->plane.read(arguments);
    for (const Weighted &one : weighted_tensors)
      if (keyword == one.name) impl_->chosen.push_back(&one);
  }
  declare(this, declared(impl_->chosen));
}

ComputeFabric::~ComputeFabric() {}

void ComputeFabric::begin_contacts() {
  impl_->sums = grainscope::FabricSums();
  impl_->moments.clear();
}

void ComputeFabric::add_contact(const Contact &c) {
  if (!both_in_group(c.i, c.j)) return;
  impl_->sums.add(c);
  if (!impl_->chosen.empty())
    impl_->moments.push_back({c.normal, c.weight, c.branch.norm(), c.normal_force, c.tangential_force.norm()});
}

void ComputeFabric::compute_vector() {
  require_tally();
  invoked_vector = update->ntimestep;
  grainscope::FabricSums all = impl_->sums;
  sum_over_ranks(all.sums.data(), all.sums.size());
  const Matrix3d fabric = all.tensor();
  std::fill(vector, vector + size_vector, 0.0);
  scalar = 0.0;
  if (all.contacts() == 0.0) return;

  const grainscope::PrincipalAxes principal(fabric);
  const int a = impl_->plane.flow, b = impl_->plane.gradient;
  scalar = std::sqrt(1.5) * (fabric - fabric.trace() / 3.0 * Matrix3d::Identity()).norm();
  double *out = put_symmetric(vector, fabric);
  out = std::copy(principal.values.data(), principal.values.data() + 3, out);
  out = std::copy(principal.vectors.data(), principal.vectors.data() + 9, out);
  *out++ = scalar;
  const double shear = 2.0 * fabric(a, b), difference = fabric(a, a) - fabric(b, b);
  const bool isotropic_in_plane = std::hypot(shear, difference) <= rounding;
  *out++ = isotropic_in_plane ? 0.0 : 0.5 * std::atan2(std::fabs(shear) <= rounding * std::fabs(difference) ? 0.0 : shear, difference);
  *out++ = principal.values[1] > rounding ? principal.values[0] / principal.values[1] : 0.0;
  *out++ = all.contacts();

  if (!impl_->chosen.empty()) {
    WeightedFabricSums weighted;
    for (const grainscope::ContactMoment &moment : impl_->moments) weighted.add(moment, fabric);
    sum_over_ranks(weighted.sums.data(), weighted.sums.size());
    for (const Weighted *one : impl_->chosen) out = put_symmetric(out, (weighted.*one->tensor)());
  }
  require_all_elements(out);
}

double ComputeFabric::compute_scalar() {
  invoked_scalar = update->ntimestep;
  if (invoked_vector != update->ntimestep) compute_vector();
  return scalar;
}

double ComputeFabric::memory_usage() { return impl_->moments.capacity() * sizeof(grainscope::ContactMoment); }

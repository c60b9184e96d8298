// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_fabric.h"
#include "arguments.h"
#include "fabric.h"
#include "plane.h"
#include "principal_axes.h"
#include "symmetric_tensor.h"
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
  const char *name;
  Matrix3d (WeightedFabricSums::*tensor)() const;
};

const Weighted weighted_tensors[] = {{"branch", &WeightedFabricSums::branch},
                                     {"force/normal", &WeightedFabricSums::normal_force},
                                     {"force/tangential", &WeightedFabricSums::tangential_force}};

const double rounding = 1e-10;  // of sums whose trace is 1

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
  scalar_flag = vector_flag = 1;
  extscalar = 0;
  extvector = 0;
  size_vector = 22 + 6 * static_cast<int>(impl_->chosen.size());
  vector = new double[size_vector]();
}

ComputeFabric::~ComputeFabric() { delete[] vector; }

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
  double *out = grainscope::write_components(fabric, vector);
  out = std::copy(principal.values.data(), principal.values.data() + 3, out);
  out = std::copy(principal.vectors.data(), principal.vectors.data() + 9, out);
  *out++ = scalar;
  const double shear = 2.0 * fabric(a, b), difference = fabric(a, a) - fabric(b, b);
  const bool isotropic_in_plane = std::hypot(shear, difference) <= rounding;
  *out++ = isotropic_in_plane ? 0.0 : 0.5 * std::atan2(std::fabs(shear) <= rounding * std::fabs(difference) ? 0.0 : shear, difference);
  *out++ = principal.values[1] > rounding ? principal.values[0] / principal.values[1] : 0.0;
  *out++ = all.contacts();

  if (impl_->chosen.empty()) return;
  WeightedFabricSums weighted;
  for (const grainscope::ContactMoment &moment : impl_->moments) weighted.add(moment, fabric);
  sum_over_ranks(weighted.sums.data(), weighted.sums.size());
  for (const Weighted *one : impl_->chosen) out = grainscope::write_components((weighted.*one->tensor)(), out);
}

double ComputeFabric::compute_scalar() {
  invoked_scalar = update->ntimestep;
  if (invoked_vector != update->ntimestep) compute_vector();
  return scalar;
}

double ComputeFabric::memory_usage() { return impl_->moments.capacity() * sizeof(grainscope::ContactMoment); }

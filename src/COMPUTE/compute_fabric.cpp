// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_fabric.h"
#include "arguments.h"
#include "contact_sums.h"
#include "fabric.h"
#include "principal_axes.h"
#include "symmetric_tensor.h"
#include "domain.h"
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

grainscope::Outputs declared(const std::vector<const Weighted *> &chosen, const grainscope::TypePairs *pairs) {
  grainscope::Outputs outputs;
  outputs.vector.add_each(six, {"F_*", "-", intensive, "fabric, mean of n_a n_b"})
      .add_each("1 2 3", {"eigenvalue_*", "-", intensive, "eigenvalue * of the fabric, descending"});
  for (const char *axis : {"1", "2", "3"})
    outputs.vector.add_each(
        "x y z", {std::string("eigenvector_") + axis + "_*", "-", intensive, std::string("* of eigenvector ") + axis});
  const grainscope::NamedOutput deviator = {"deviator", "-", intensive,
                                            "sqrt(3/2 F':F'), in two dimensions sqrt(2 F':F')"};
  outputs.vector.add(deviator)
      .add({"angle", "rad", intensive, "principal angle in the plane"})
      .add({"ratio", "-", intensive, "anisotropy, eigenvalue_1 over eigenvalue_2"})
      .add({"N_c", "-", whole, "contacts"});
  for (const Weighted *one : chosen)
    outputs.vector.add_each(six,
                            {std::string(one->output) + "_*", "-", intensive, std::string(one->name) + " tensor, *"});
  outputs.scalar = {deviator};
  if (!pairs) return outputs;
  grainscope::OutputList columns = {{"pair_a", "-", intensive, "atom type"},
                                    {"pair_b", "-", intensive, "atom type, a wall's too, >= pair_a"}};
  columns.add_each(six, {"pair_F_*", "-", intensive, "fabric of their contacts, *"})
      .add({"pair_N_c", "-", whole, "their contacts"});
  outputs.set_array(pairs->size(), "pair of atom types", columns);
  return outputs;
}

/** The weights depend on the fabric of all contacts: weighted tensors need a second pass. */
struct Moments : grainscope::ContactCompute::Accumulator {
  std::vector<grainscope::ContactMoment> of_contacts;

  void reset() override { of_contacts.clear(); }
  void add(grainscope::ContactSpan contacts, const grainscope::ContactCompute &of) override {
    grainscope::for_each_contact(contacts, of.selection(), [this](const Contact &c) {
      of_contacts.push_back({c.normal, c.weight, c.branch.norm(), c.normal_force, c.tangential_force.norm()});
    });
  }
};

}

struct ComputeFabric::Impl {
  std::vector<const Weighted *> chosen;
  grainscope::ContactSums<grainscope::FabricSums> sums;
  Moments moments;
  std::unique_ptr<grainscope::TypePairSums<grainscope::FabricSums>> of_types;  // of 'rows types'
};

ComputeFabric::ComputeFabric(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : ContactCompute(lmp, iarg, narg, arg,
                     grainscope::Scope::region | grainscope::Scope::types | grainscope::Scope::rows |
                         grainscope::Scope::walls | grainscope::Scope::plane,
                     grainscope::Walls::no),
      impl_(new Impl) {
  grainscope::Arguments arguments(lmp, name_, iarg, narg, arg);
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword(scope_.with({"branch", "force/normal", "force/tangential"}));
    scope_.read(arguments, keyword);
    for (const Weighted &one : weighted_tensors)
      if (keyword == one.name) impl_->chosen.push_back(&one);
  }
  sums_over(impl_->sums);
  if (!impl_->chosen.empty()) sums_over(impl_->moments);
  if (scope_.by_types()) {
    impl_->of_types.reset(new grainscope::TypePairSums<grainscope::FabricSums>(type_pairs()));
    sums_over(*impl_->of_types);
  }
  declare(this, declared(impl_->chosen, impl_->of_types ? &impl_->of_types->pairs() : nullptr));
}

ComputeFabric::~ComputeFabric() {}

void ComputeFabric::answer() {
  const grainscope::FabricSums &all = impl_->sums.total(*this);
  const Matrix3d fabric = all.tensor();
  std::fill(vector, vector + size_vector, 0.0);
  scalar = 0.0;
  if (impl_->of_types) put_rows();
  if (all.contacts() == 0.0) return;

  const int dimension = domain->dimension;
  const grainscope::PrincipalAxes principal(fabric, dimension);
  const int a = scope_.shear_plane().flow, b = scope_.shear_plane().gradient;
  scalar = grainscope::fabric_deviator(fabric, dimension);
  double *out = grainscope::write_components(fabric, vector);
  out = std::copy(principal.values.data(), principal.values.data() + 3, out);
  out = std::copy(principal.vectors.data(), principal.vectors.data() + 9, out);
  *out++ = scalar;
  const double shear = 2.0 * fabric(a, b), difference = fabric(a, a) - fabric(b, b);
  const bool isotropic_in_plane = std::hypot(shear, difference) <= rounding;
  *out++ = isotropic_in_plane
               ? 0.0
               : 0.5 * std::atan2(std::fabs(shear) <= rounding * std::fabs(difference) ? 0.0 : shear, difference);
  *out++ = principal.values[1] > rounding ? principal.values[0] / principal.values[1] : 0.0;
  *out++ = all.contacts();

  if (!impl_->chosen.empty()) {
    WeightedFabricSums weighted(dimension);
    for (const grainscope::ContactMoment &moment : impl_->moments.of_contacts) weighted.add(moment, fabric);
    sum_over_ranks(weighted.sums.data(), weighted.sums.size());
    for (const Weighted *one : impl_->chosen) out = grainscope::write_components((weighted.*one->tensor)(), out);
  }
  require_all_elements(out);
}

void ComputeFabric::put_rows() {
  const std::vector<std::pair<int, int>> pairs = impl_->of_types->pairs().all();
  const std::vector<grainscope::FabricSums> rows = impl_->of_types->total(*this);
  for (std::size_t row = 0; row < rows.size(); row++) {
    const Matrix3d f = rows[row].tensor();
    put_row(row, {static_cast<double>(pairs[row].first), static_cast<double>(pairs[row].second), f(0, 0), f(1, 1),
                  f(2, 2), f(0, 1), f(0, 2), f(1, 2), rows[row].contacts()});
  }
}

double ComputeFabric::memory_usage() {
  return impl_->moments.of_contacts.capacity() * sizeof(grainscope::ContactMoment);
}

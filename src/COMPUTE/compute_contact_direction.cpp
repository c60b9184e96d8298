// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_contact_direction.h"
#include "arguments.h"
#include "contact_sums.h"
#include "direction_sums.h"
#include <algorithm>

using namespace LAMMPS_NS;
using grainscope::DirectionSums;

namespace {

constexpr auto intensive = grainscope::Extent::intensive, whole = grainscope::Extent::whole;

grainscope::Outputs declared(int bins) {
  grainscope::Outputs outputs;
  outputs.set_array(
      bins, "bin of beta",
      {{"beta", "rad", intensive, "angle of the bin's middle"},
       {"N_c", "-", whole, "contacts, each at beta and at beta + pi"},
       {"density", "1/rad", intensive, "share of the contacts over the width of a bin, integral 1"},
       {"F_n", "force", intensive, "normal force in the plane, mean over the bin's contacts"},
       {"F_t", "force", intensive, "tangential force in the plane, mean over the bin's contacts"},
       {"F_along", "force", intensive, "tangential force along (-sin beta, cos beta), mean over the bin's contacts"},
       {"F_n_sum", "force", whole, "sum of which F_n is the mean"},
       {"F_t_sum", "force", whole, "sum of which F_t is the mean"},
       {"F_along_sum", "force", whole, "sum of which F_along is the mean"}});
  return outputs;
}

}

struct ComputeContactDirection::Impl {
  grainscope::ContactSums<DirectionSums> sums;
};

ComputeContactDirection::ComputeContactDirection(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : ContactCompute(lmp, iarg, narg, arg,
                     grainscope::Scope::region | grainscope::Scope::types | grainscope::Scope::walls |
                         grainscope::Scope::plane,
                     grainscope::Walls::no),
      impl_(new Impl) {
  grainscope::Arguments arguments(lmp, name_, iarg, narg, arg);
  int half = 36;  // bins from 0 to pi; the other half is their mirror image
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword(scope_.with({"bins"}));
    if (!scope_.read(arguments, keyword)) half = arguments.even_number(keyword, 2, 10000) / 2;
  }
  const grainscope::Plane &plane = scope_.shear_plane();
  impl_->sums = grainscope::ContactSums<DirectionSums>(DirectionSums(plane.flow, plane.gradient, half));
  sums_over(impl_->sums);
  declare(this, declared(2 * half));
}

ComputeContactDirection::~ComputeContactDirection() {}

void ComputeContactDirection::answer() {
  const DirectionSums &all = impl_->sums.total(*this);
  require_finite(all.not_finite());
  const double contacts = all.contacts(), bin = all.width();
  for (int k = 0; k < 2 * all.bins(); k++) {
    const DirectionSums::Bin s = all.bin(k % all.bins());
    const double per_contact = s.contacts > 0.0 ? 1.0 / s.contacts : 0.0;
    const double density = contacts > 0.0 ? s.contacts / (2.0 * contacts * bin) : 0.0;
    put_row(k, {(k + 0.5) * bin, s.contacts, density, s.normal * per_contact, s.tangential * per_contact,
                s.along * per_contact, s.normal, s.tangential, s.along});
  }
}

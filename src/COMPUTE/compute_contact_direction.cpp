// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_contact_direction.h"
#include "arguments.h"
#include "bin_index.h"
#include "contact.h"
#include "plane.h"
#include "update.h"
#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using grainscope::Contact;

namespace {

constexpr auto intensive = grainscope::Extent::intensive, whole = grainscope::Extent::whole;

enum { CONTACTS, NORMAL, TANGENTIAL, ALONG, SUMS };

grainscope::Outputs declared(int bins) {
  grainscope::Outputs outputs;
  outputs.set_array(bins, "bin of beta", {
      {"beta", "rad", intensive, "angle of the bin's middle"},
      {"N_c", "-", whole, "contacts, each at beta and at beta + pi"},
      {"density", "1/rad", intensive, "share of the contacts over the width of a bin, integral 1"},
      {"F_n", "force", intensive, "normal force in the plane, mean over the bin's contacts"},
      {"F_t", "force", intensive, "tangential force in the plane, mean over the bin's contacts"},
      {"F_along", "force", intensive, "tangential force along (-sin beta, cos beta), mean over the bin's contacts"},
      {"F_n_sum", "force", whole, "sum that F_n is the mean of"},
      {"F_t_sum", "force", whole, "sum that F_t is the mean of"},
      {"F_along_sum", "force", whole, "sum that F_along is the mean of"}});
  return outputs;
}

}

struct ComputeContactDirection::Impl {
  grainscope::Plane plane;
  int half = 36;             // bins from 0 to pi; the other half is their mirror image
  std::vector<double> sums;  // half x SUMS, and contacts whose direction is not finite
};

ComputeContactDirection::ComputeContactDirection(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : ContactCompute(lmp, iarg, narg, arg), impl_(new Impl) {
  grainscope::Arguments arguments(lmp, name_, iarg, narg, arg);
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword({"plane", "bins"});
    if (keyword == "plane") impl_->plane.read(arguments);
    else impl_->half = arguments.even_number(keyword, 2, 10000) / 2;
  }
  declare(this, declared(2 * impl_->half));
}

ComputeContactDirection::~ComputeContactDirection() {}

void ComputeContactDirection::begin_contacts() { impl_->sums.assign(impl_->half * SUMS + 1, 0.0); }

void ComputeContactDirection::add_contact(const Contact &c) {
  if (!both_in_group(c.i, c.j)) return;
  const int a = impl_->plane.flow, b = impl_->plane.gradient;
  const auto projected = [a, b](const Eigen::Vector3d &v) { return std::sqrt(v[a] * v[a] + v[b] * v[b]); };
  const double length = projected(c.normal);
  if (length < 1e-9) return;
  // beta and beta + pi are one line; the component along (-sin beta, cos beta) is the same for both grains.
  double beta = std::atan2(c.normal[b], c.normal[a]);
  if (beta < 0.0) beta += M_PI;
  const int upto_pi = grainscope::bin_index(beta / M_PI * impl_->half, impl_->half + 1);
  if (upto_pi < 0) {
    impl_->sums.back() += c.weight;
    return;
  }
  const int bin = upto_pi % impl_->half;
  const double along = (c.tangential_force[b] * c.normal[a] - c.tangential_force[a] * c.normal[b]) / length;
  double *s = &impl_->sums[bin * SUMS];
  s[CONTACTS] += c.weight;
  s[NORMAL] += c.weight * std::fabs(c.normal_force) * length;
  s[TANGENTIAL] += c.weight * projected(c.tangential_force);
  s[ALONG] += c.weight * along;
}

void ComputeContactDirection::compute_array() {
  require_tally();
  invoked_array = update->ntimestep;
  std::vector<double> all = impl_->sums;
  sum_over_ranks(all.data(), all.size());
  require_finite(all.back());
  double contacts = 0.0;
  for (int k = 0; k < impl_->half; k++) contacts += all[k * SUMS + CONTACTS];
  const double bin = M_PI / impl_->half;
  for (int k = 0; k < 2 * impl_->half; k++) {
    const double *s = &all[k % impl_->half * SUMS];
    const double per_contact = s[CONTACTS] > 0.0 ? 1.0 / s[CONTACTS] : 0.0;
    const double density = contacts > 0.0 ? s[CONTACTS] / (2.0 * contacts * bin) : 0.0;
    put_row(k, {(k + 0.5) * bin, s[CONTACTS], density, s[NORMAL] * per_contact, s[TANGENTIAL] * per_contact,
                s[ALONG] * per_contact, s[NORMAL], s[TANGENTIAL], s[ALONG]});
  }
}

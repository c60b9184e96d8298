// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_contact_force.h"
#include "arguments.h"
#include "branches.h"
#include "contact_sums.h"
#include "force_statistics.h"
#include "require_finite.h"
#include "atom.h"
#include "domain.h"
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

using namespace LAMMPS_NS;
using grainscope::ContactForce;

namespace {

constexpr auto intensive = grainscope::Extent::intensive, whole = grainscope::Extent::whole;

grainscope::Outputs declared(int bins) {
  grainscope::Outputs outputs;
  const grainscope::NamedOutput mean = {"F_n", "force", intensive, "mean normal force"};
  outputs.scalar = {mean};
  outputs.vector = {
      mean,
      {"F_t", "force", intensive, "mean magnitude of the tangential force"},
      {"F_n_rms", "force", intensive, "root mean square of the normal force"},
      {"F_t_rms", "force", intensive, "root mean square of the tangential force"},
      {"F_n_max", "force", intensive, "largest normal force"},
      {"F_t_max", "force", intensive, "largest magnitude of the tangential force"},
      {"participation", "-", intensive, "<F_n>^2/<F_n^2>, 1 when all are equal"},
      {"beta", "-", intensive, "exponent of the tail, P ~ exp(-beta f) from its start on"},
      {"beta_error", "-", intensive, "standard error of beta"},
      {"alpha", "-", intensive, "exponent of weak forces, P ~ f^-alpha for f < 1"},
      {"alpha_error", "-", intensive, "standard error of alpha"},
      {"strong_pressure", "-", intensive, "share of strong contacts in the pressure, trace of the stress"},
      {"strong_deviator", "-", intensive, "share of strong contacts in the deviator of the stress"},
      {"N_c", "-", whole, "contacts between grains"},
      {"N_w", "-", whole, "contacts with walls"},
      {"N_strong", "-", whole, "strong contacts, F_n > <F_n>"},
      {"N_negative", "-", whole, "contacts with F_n < 0"},
      {"N_tail", "-", whole, "contacts in the tail"},
      {"N_weak", "-", whole, "contacts with 0 < f < 1"},
      {"clusters", "-", whole, "clusters of grains that strong contacts connect"},
      {"cluster_max", "-", whole, "grains of the largest cluster"},
      {"F_n_sum", "force", whole, "sum of which F_n is the mean"},
      {"F_t_sum", "force", whole, "sum of which F_t is the mean"},
      {"F_n2_sum", "force^2", whole, "sum of F_n^2"},
      {"F_t2_sum", "force^2", whole, "sum of F_t^2"},
      {"tail_sum", "-", whole, "sum over the tail of f - f_start: beta = N_tail/tail_sum"},
      {"weak_sum", "-", whole, "sum over weak forces of -ln f: alpha = 1 - N_weak/weak_sum"}};
  outputs.set_array(bins, "bin of f",
                    {{"f", "-", intensive, "F_n/<F_n> of the bin's middle"},
                     {"P_f", "-", intensive, "density of f: share of the contacts over the width of a bin"},
                     {"N_f", "-", whole, "contacts in the bin"}});
  return outputs;
}

/** Grains of each cluster: the parts of all ranks, added up. Collective. */
std::map<double, double> total(const std::map<double, double> &mine, MPI_Comm world) {
  std::vector<double> parts, all;
  for (const auto &one : mine) parts.insert(parts.end(), {one.first, one.second});
  int ranks = 0, size = static_cast<int>(parts.size());
  MPI_Comm_size(world, &ranks);
  std::vector<int> sizes(ranks), begins(ranks + 1, 0);
  MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, world);
  std::partial_sum(sizes.begin(), sizes.end(), begins.begin() + 1);
  all.resize(begins.back());
  MPI_Allgatherv(parts.data(), size, MPI_DOUBLE, all.data(), sizes.data(), begins.data(), MPI_DOUBLE, world);
  std::map<double, double> grains;
  for (std::size_t k = 0; k < all.size(); k += 2) grains[all[k]] += all[k + 1];
  return grains;
}

bool positive(double x) { return x > 0.0; }
bool not_negative(double x) { return x >= 0.0; }

}

struct ComputeContactForce::Impl {
  std::vector<ContactForce> contacts;  // of this rank
  std::vector<Link> links;             // between which grains
  grainscope::ForceMoments moments, all_moments;
  grainscope::ForceDistribution distribution, all;
  double clusters = 0.0, largest_cluster = 0.0;  // of all ranks
};

ComputeContactForce::ComputeContactForce(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : ContactNetworkCompute(lmp, iarg, narg, arg,
                            grainscope::Scope::region | grainscope::Scope::types | grainscope::Scope::walls),
      impl_(new Impl) {
  grainscope::Arguments arguments(lmp, name_, iarg, narg, arg);
  int bins = 60;
  double most = 6.0, tail = 1.0;
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword(scope_.with({"bins", "max", "tail"}));
    if (scope_.read(arguments, keyword)) continue;
    if (keyword == "bins") bins = arguments.whole_number(keyword, 1, 10000);
    if (keyword == "max") most = arguments.number(keyword, "a positive number", positive);
    if (keyword == "tail") tail = arguments.number(keyword, "a number, not negative", not_negative);
  }
  impl_->distribution = impl_->all = grainscope::ForceDistribution(bins, most, tail);
  declare(this, declared(bins));
}

ComputeContactForce::~ComputeContactForce() {}

void ComputeContactForce::begin_contacts() {
  ContactNetworkCompute::begin_contacts();
  impl_->contacts.clear();
  impl_->links.clear();
  impl_->moments.reset();
}

void ComputeContactForce::add_contacts(grainscope::ContactSpan contacts) {
  grainscope::for_each_contact(contacts, selection(), [this](const grainscope::Contact &c) {
    if (!is_mine(c)) return;
    impl_->contacts.push_back(ContactForce(c, grainscope::branch_of(c, bodies())));
    impl_->links.push_back(link(c));
    impl_->moments.add(impl_->contacts.back());
  });
}

void ComputeContactForce::end_contacts() {
  Impl &my = *impl_;
  my.all_moments = my.moments;
  sum_over_ranks(my.all_moments.sums.data(), my.all_moments.sums.size());
  double largest[2] = {my.moments.largest_normal, my.moments.largest_tangential};
  MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPI_DOUBLE, MPI_MAX, world);
  my.all_moments.largest_normal = my.all_moments.contacts() > 0.0 ? largest[0] : 0.0;
  my.all_moments.largest_tangential = largest[1];

  const double mean = my.all_moments.mean_normal();
  my.distribution.reset();
  for (const ContactForce &c : my.contacts) my.distribution.add(c, mean);
  my.all = my.distribution;
  sum_over_ranks(my.all.numbers().data(), my.all.numbers().size());
  find_clusters(mean);
}

void ComputeContactForce::find_clusters(double mean) {
  Impl &my = *impl_;
  std::vector<Link> strong;
  for (std::size_t k = 0; k < my.links.size(); k++)
    if (grainscope::is_strong(my.contacts[k].normal, mean)) strong.push_back(my.links[k]);
  const std::vector<double> cluster = clusters(strong);
  std::map<double, double> grains;  // of each cluster, on this rank
  for (int i = 0; i < atom->nlocal; i++) {
    const double of_grain = cluster[number_of(i)];
    if (of_grain > 0.0 && bodies().stands_for_itself_or_clump(i)) grains[of_grain] += 1.0;
  }
  my.clusters = my.largest_cluster = 0.0;
  for (const auto &one : total(grains, world)) {
    my.clusters += 1.0;
    my.largest_cluster = std::max(my.largest_cluster, one.second);
  }
}

void ComputeContactForce::answer() {
  const grainscope::ForceMoments &m = impl_->all_moments;
  const grainscope::ForceDistribution &p = impl_->all;
  grainscope::require_finite(lmp, name_ + " " + id, m.not_finite(), "the force",
                             "contacts is not finite: check what moves or pushes these grains");
  const double n = m.contacts(), per_contact = n > 0.0 ? 1.0 / n : 0.0;
  const double mean_square = m.normal_squared() * per_contact;
  scalar = m.mean_normal();
  put_vector({scalar,
              m.tangential() * per_contact,
              std::sqrt(mean_square),
              std::sqrt(m.tangential_squared() * per_contact),
              m.largest_normal,
              m.largest_tangential,
              mean_square > 0.0 ? scalar * scalar / mean_square : 0.0,
              p.tail_exponent(),
              p.tail_error(),
              p.weak_exponent(),
              p.weak_error(),
              p.strong_pressure(),
              p.strong_deviator(domain->dimension),
              m.of_grains(),
              m.with_walls(),
              p.strong(),
              p.negative(),
              p.tail(),
              p.weak(),
              impl_->clusters,
              impl_->largest_cluster,
              m.normal(),
              m.tangential(),
              m.normal_squared(),
              m.tangential_squared(),
              p.tail_sum(),
              p.weak_sum()});
  for (int k = 0; k < p.bins(); k++)
    put_row(k, {(k + 0.5) * p.width(), p.in_bin(k) * per_contact / p.width(), p.in_bin(k)});
}

double ComputeContactForce::memory_usage() {
  return impl_->contacts.capacity() * sizeof(ContactForce) + impl_->links.capacity() * sizeof(Link);
}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_packing.h"
#include "arguments.h"
#include "branches.h"
#include "contact_network.h"
#include "contact_observer.h"
#include "contact_sums.h"
#include "grain_shape.h"
#include "stress.h"
#include "atom.h"
#include "domain.h"
#include "force.h"
#include "update.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace LAMMPS_NS;

namespace {

constexpr auto intensive = grainscope::Extent::intensive, whole = grainscope::Extent::whole;

grainscope::Outputs declared() {
  grainscope::Outputs outputs;
  const grainscope::NamedOutput phi = {"phi", "-", intensive, "solid fraction, V_s/Omega"};
  outputs.scalar = {phi};
  outputs.vector = {phi,
                    {"d", "distance", intensive, "mean diameter of the spheres of the grains' volumes"},
                    {"I", "-", intensive, "inertial number, rate d sqrt(rho/P)"},
                    {"Z", "-", intensive, "coordination number, (2 N_c + N_w)/N"},
                    {"Z_backbone", "-", intensive, "coordination number without rattlers"},
                    {"rattlers", "-", intensive, "fraction of the grains that are rattlers"},
                    {"N", "-", whole, "grains"},
                    {"N_c", "-", whole, "contacts between grains"},
                    {"N_w", "-", whole, "contacts with walls"},
                    {"N_rattlers", "-", whole, "grains that are rattlers"},
                    {"N_c_backbone", "-", whole, "contacts between grains that are no rattlers"},
                    {"N_w_backbone", "-", whole, "contacts of such grains with walls"},
                    {"P", "pressure", intensive, "pressure of the contacts"},
                    {"rate", "1/time", intensive, "shear rate in I"},
                    {"rho", "mass/volume", intensive, "density of the grains, their mass over V_s"},
                    {"V_s", "volume", whole, "volume of the grains"},
                    {"Omega", "volume", whole, "volume in phi and P"},
                    {"d_spread", "-", intensive, "standard deviation of the diameters over d"}};
  return outputs;
}

/** A grain with fewer contacts is held by none of them: four in space, as of frictionless spheres; in a plane two. */
int usual_limit(int dimension) { return dimension == 2 ? 2 : 4; }

double ratio(double a, double b) { return b > 0.0 ? a / b : 0.0; }

}

struct ComputePacking::Impl {
  explicit Impl(LAMMPS *lmp) : rate(lmp, "compute packing", "rate", rate_requirement) {}
  static constexpr const char *rate_requirement = "auto, a positive number or v_name";

  grainscope::ContactSums<grainscope::StressSums, grainscope::Branches> stress;
  grainscope::RattlerSearch search;
  grainscope::NumberSource rate;  // none: the box's
  int limit = 0;                  // contacts of a grain that is no rattler; 0: the usual
  /** Of the last evaluation: of grains, and of contacts of the backbone. */
  struct Sums {
    double grains = 0.0, rattlers = 0.0, volume = 0.0, mass = 0.0, diameter = 0.0, diameter2 = 0.0;
    double contacts = 0.0, wall_contacts = 0.0;
  };
  Sums of_rank;
};

ComputePacking::ComputePacking(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : ContactNetworkCompute(lmp, iarg, narg, arg,
                            grainscope::Scope::region | grainscope::Scope::walls | grainscope::Scope::volume |
                                grainscope::Scope::plane | grainscope::Scope::pressure),
      impl_(new Impl(lmp)) {
  grainscope::Arguments arguments(lmp, name_, iarg, narg, arg);
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword(scope_.with({"rate", "rattlers"}));
    if (scope_.read(arguments, keyword)) continue;
    if (keyword == "rattlers") {
      impl_->limit = arguments.whole_number(keyword, 1, 100);
      continue;
    }
    const std::string word = arguments.word(Impl::rate_requirement);
    if (word != "auto") impl_->rate.set(arguments, word);
  }
  sums_over(impl_->stress);
  declare(this, declared());
}

ComputePacking::~ComputePacking() {}

void ComputePacking::init() {
  ContactNetworkCompute::init();
  impl_->rate.init();
}

void ComputePacking::begin_contacts() {
  ContactNetworkCompute::begin_contacts();
  impl_->search.reset();
}

/** Rattlers are found among all grains of the group; those in a region, and contacts there, are counted. */
void ComputePacking::add_contacts(grainscope::ContactSpan contacts) {
  ContactNetworkCompute::add_contacts(contacts);
  grainscope::for_each_contact(contacts, selection().everywhere(), [this](const grainscope::Contact &c) {
    const bool counts = !scope_.within() || scope_.has_place(c.motion->point);
    impl_->search.add(c, number_of(c.i), c.with_wall() ? grainscope::RattlerSearch::wall : number_of(c.j()),
                      counts ? c.weight : 0.0);
  });
}

/** 1 for the grains of the group, by their numbers. */
std::vector<double> ComputePacking::grains_of_group() const {
  std::vector<double> held(numbers_of_grains());
  const int first = local_and_ghosts(), clumps = static_cast<int>(held.size()) - first;
  for (int i = 0; i < first; i++)
    if (in_group(i) && bodies().stands_for_itself_or_clump(i)) held[number_of(i)] = 1.0;
  MPI_Allreduce(MPI_IN_PLACE, held.data() + first, clumps, MPI_DOUBLE, MPI_MAX, world);
  return held;
}

void ComputePacking::find_rattlers(std::vector<double> &held) {
  const grainscope::RattlerSearch &search = impl_->search;
  const int limit = impl_->limit ? impl_->limit : usual_limit(domain->dimension);
  const int first = local_and_ghosts(), clumps = static_cast<int>(held.size()) - first;
  bool removed = true;
  while (on_any_rank(removed)) {
    removed = search.remove(limit, atom->nlocal, held);
    owners_to_ghosts(held);
    if (clumps == 0) continue;
    std::vector<double> contacts = search.degrees(held);
    sum_over_ranks(contacts.data() + first, clumps);
    for (std::size_t k = first; k < held.size(); k++)
      if (held[k] != 0.0 && contacts[k] < limit) {
        held[k] = 0.0;
        removed = true;
      }
  }
}

void ComputePacking::end_contacts() {
  Impl &my = *impl_;
  std::vector<double> held = grains_of_group();
  find_rattlers(held);
  const std::array<double, 2> backbone = my.search.contacts(held);
  my.of_rank = Impl::Sums();
  my.of_rank.contacts = backbone[0];
  my.of_rank.wall_contacts = backbone[1];
  for (int i = 0; i < atom->nlocal; i++)
    if (in_group(i) && bodies().stands_for_itself_or_clump(i)) add_grain(i, held[number_of(i)] == 0.0);
}

/** Local grain i, or the clump that it stands for, when its centre is in the region. */
void ComputePacking::add_grain(int i, bool rattler) {
  const grainscope::Body *const body = bodies().of(i);
  if (!scope_.has_place(body ? body->centre : Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(atom->x[i])))) return;
  Impl::Sums &sums = impl_->of_rank;
  const double d = body ? std::cbrt(6.0 / M_PI * body->volume) : grainscope::equivalent_diameter(*atom, i);
  sums.grains += 1.0;
  sums.rattlers += rattler ? 1.0 : 0.0;
  sums.volume += body ? body->volume : grainscope::solid_volume(*atom, i, domain->dimension);
  sums.mass += body ? body->mass : atom->rmass[i];
  sums.diameter += d;
  sums.diameter2 += d * d;
}

void ComputePacking::answer() {
  const Impl &my = *impl_;
  const grainscope::StressSums &sums = impl_->stress.total(*this);
  const grainscope::BoxState &box = observer_->box();
  const double omega = scope_.volume_now(box);
  Impl::Sums all = my.of_rank;
  static_assert(sizeof all == 8 * sizeof(double), "what ranks add up");
  sum_over_ranks(&all.grains, 8);
  const double n = all.grains, d = ratio(all.diameter, n), rho = ratio(all.mass, all.volume);
  const double spread = std::sqrt(std::max(0.0, ratio(all.diameter2, n) - d * d));

  const double pressure = scope_.pressure_of(sums.total(1.0), domain->dimension) * force->nktv2p / omega + 0.0;
  if (!std::isfinite(pressure))
    grainscope::Arguments(lmp, name_ + " " + id)
        .fail("step " + std::to_string(update->ntimestep) +
              ": the pressure is not finite: check overlaps and material properties");
  const grainscope::Plane &plane = scope_.shear_plane();
  const double rate = my.rate.given() ? my.rate.now() : std::fabs(box.velocity_gradient(plane.flow, plane.gradient));
  const double inertial = pressure > 0.0 ? rate * d * std::sqrt(rho * force->mvv2e * force->nktv2p / pressure) : 0.0;
  const double of_grains = sums.contacts_of_grains(), with_walls = sums.contacts_with_walls();
  scalar = all.volume / omega;
  put_vector({scalar, d, inertial, ratio(2.0 * of_grains + with_walls, n),
              ratio(2.0 * all.contacts + all.wall_contacts, n - all.rattlers), ratio(all.rattlers, n), n, of_grains,
              with_walls, all.rattlers, all.contacts, all.wall_contacts, pressure, rate, rho, all.volume, omega,
              ratio(spread, d)});
}

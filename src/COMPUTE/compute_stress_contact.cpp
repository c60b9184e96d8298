// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_stress_contact.h"
#include "arguments.h"
#include "branches.h"
#include "contact_law.h"
#include "contact_observer.h"
#include "contact_sums.h"
#include "fluctuations.h"
#include "neighbour_list_watch.h"
#include "stress_lanes.h"
#include "symmetric_tensor.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_property_global.h"
#include "finite.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace LAMMPS_NS;

namespace {

using grainscope::StressSums;

// Bilotto et al. 2025, Sec. II: above it results do not depend on the stiffness.
const double hard_grains = 1.1e3;
constexpr auto intensive = grainscope::Extent::intensive, whole = grainscope::Extent::whole;

grainscope::Outputs declared(const grainscope::TypePairs *pairs) {
  const char *const six = "xx yy zz xy xz yz";
  grainscope::Outputs outputs;
  const grainscope::NamedOutput pressure = {"P", "pressure", intensive,
                                            "pressure, -syy unless the keyword pressure says otherwise"};
  outputs.scalar = {pressure};
  outputs.vector.add_each(six, {"s*", "pressure", intensive, "stress sigma_*, tension positive"})
      .add({"syx", "pressure", intensive, "stress sigma_yx, from F_y r_x"})
      .add_each(six, {"s*_normal", "pressure", intensive, "part of s* from normal forces"})
      .add_each(six, {"s*_tangential", "pressure", intensive, "part of s* from tangential forces"})
      .add_each(six, {"s*_kinetic", "pressure", intensive, "kinetic stress *, not in s*"})
      .add(pressure)
      .add({"mu_eff", "-", intensive, "effective friction, sxy/P; with plane, that of the plane"})
      .add({"N1", "-", intensive, "first normal stress difference, (sxx - syy)/P; with plane, that of the plane"})
      .add({"N2", "-", intensive,
            "second normal stress difference, (syy - szz)/P; with plane, that of the plane; 0 in two dimensions"})
      .add({"N_c", "-", whole, "contacts between grains"})
      .add({"Z", "-", intensive, "coordination number, (2 N_c + N_w)/N"})
      .add({"sliding", "-", intensive, "fraction of contacts that slide"})
      .add({"overlap_mean", "distance", intensive, "mean overlap"})
      .add({"overlap_max", "distance", intensive, "largest overlap"})
      .add({"kappa", "-", intensive, "stiffness number, min(alpha, 1) (E/P)^(2/3); in two dimensions (E d/P)^(2/3)"})
      .add({"N_w", "-", whole, "contacts with walls"});
  if (!pairs) return outputs;
  grainscope::OutputList columns = {{"pair_a", "-", intensive, "atom type"},
                                    {"pair_b", "-", intensive, "atom type, a wall's too, >= pair_a"}};
  columns.add_each(six, {"pair_s*", "pressure", intensive, "their part of s*"})
      .add({"pair_syx", "pressure", intensive, "their part of syx"})
      .add({"pair_N_c", "-", whole, "their contacts between grains"})
      .add({"pair_N_w", "-", whole, "their contacts with walls"})
      .add({"pair_N_sliding", "-", whole, "sliding contacts of the pair of types"});
  outputs.set_array(pairs->size(), "pair of atom types", columns);
  return outputs;
}

}

struct ComputeStressContact::Impl {
  grainscope::ContactSums<StressSums, grainscope::Branches, grainscope::StressLanes> sums;
  std::unique_ptr<grainscope::TypePairSums<StressSums, grainscope::Branches>> of_types;  // of 'rows types'
  grainscope::NeighbourListWatch watch;  // of the grains that stiffness_ is of
};

ComputeStressContact::ComputeStressContact(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : ContactCompute(lmp, iarg, narg, arg,
                     grainscope::Scope::region | grainscope::Scope::types | grainscope::Scope::rows |
                         grainscope::Scope::walls | grainscope::Scope::volume | grainscope::Scope::plane |
                         grainscope::Scope::pressure),
      impl_(new Impl) {
  grainscope::Arguments arguments(lmp, name_, iarg, narg, arg);
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword(scope_.with({}));
    scope_.read(arguments, keyword);
  }
  sums_over(impl_->sums);
  if (scope_.by_types()) {
    impl_->of_types.reset(new grainscope::TypePairSums<StressSums, grainscope::Branches>(type_pairs()));
    sums_over(*impl_->of_types);
  }
  declare(this, declared(impl_->of_types ? &impl_->of_types->pairs() : nullptr));
}

ComputeStressContact::~ComputeStressContact() {}

void ComputeStressContact::init() {
  ContactCompute::init();
  impl_->watch = grainscope::NeighbourListWatch();
  if (!knows_sliding() && comm->me == 0)
    error->warning(FLERR,
                   "compute stress/contact: sliding is known for 'tangential' off, no_history and history only; "
                   "other contacts are never counted as sliding (output sliding, doc/compute_stress_contact.md)");
}

/** Of all contacts that are counted. */
bool ComputeStressContact::knows_sliding() const {
  const std::vector<const grainscope::ContactLaw *> laws = laws_of_contacts();
  return std::all_of(laws.begin(), laws.end(), [](const grainscope::ContactLaw *law) { return law->knows_sliding(); });
}

/** Smallest Young's modulus among the types of the group; 0 when the deck defines none. */
double ComputeStressContact::softest_modulus() const {
  auto *moduli = static_cast<FixPropertyGlobal *>(
      modify->find_fix_property("youngsModulus", "property/global", "peratomtype", 0, 0, style, false));
  if (!moduli) return 0.0;
  std::vector<char> present(atom->ntypes + 1, false);
  for (int i = 0; i < atom->nlocal; i++)
    if (in_group(i)) present[atom->type[i]] = true;
  double softest = HUGE_VAL;
  for (int type = 1; type <= atom->ntypes; type++)
    if (present[type]) softest = std::min(softest, moduli->compute_vector(type - 1));
  MPI_Allreduce(MPI_IN_PLACE, &softest, 1, MPI_DOUBLE, MPI_MIN, world);
  return std::isfinite(softest) ? softest : 0.0;
}

/** Smallest over the group of shortest / middle semi-axis: min(alpha, 1) for spheroids. */
double ComputeStressContact::flattest_shape() const {
  double flattest = 1.0;
  if (atom->superquadric_flag)
    for (int i = 0; i < atom->nlocal; i++) {
      if (!in_group(i)) continue;
      const double *s = atom->shape[i];
      const double low = std::min(s[0], s[1]), high = std::max(s[0], s[1]);
      flattest = std::min(flattest, std::min(low, s[2]) / std::max(low, std::min(high, s[2])));
    }
  MPI_Allreduce(MPI_IN_PLACE, &flattest, 1, MPI_DOUBLE, MPI_MIN, world);
  return flattest;
}

/** Of the group; 0 without grains. */
double ComputeStressContact::mean_diameter() const {
  double sums[2] = {0.0, 0.0};
  for (int i = 0; i < atom->nlocal; i++) {
    if (!in_group(i)) continue;
    sums[0] += 2.0 * atom->radius[i];
    sums[1] += 1.0;
  }
  sum_over_ranks(sums, 2);
  return sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
}

void ComputeStressContact::answer() {
  const StressSums &all = impl_->sums.total(*this);
  double largest_overlap = impl_->sums.mine().largest_overlap;
  MPI_Allreduce(MPI_IN_PLACE, &largest_overlap, 1, MPI_DOUBLE, MPI_MAX, world);

  const grainscope::BoxState &box = observer_->box();
  const auto motion = grainscope::MomentumFlux::of(lmp, {name_, groupbit, scope_.within()}, box);
  // Forces over areas are in pressure units only where force->nktv2p is 1; cgs and si both are.
  const double unit = force->nktv2p / scope_.volume_now(box);
  const Eigen::Matrix3d total = all.total(1.0) * unit;
  const Eigen::Matrix3d tangential = all.tangential(1.0) * unit;
  const Eigen::Matrix3d kinetic = -motion.sum * force->mvv2e * unit;
  const Eigen::Matrix3d normal = total - tangential;

  double *out = grainscope::write_components(total, vector);
  *out++ = total(1, 0);
  for (const Eigen::Matrix3d *part : {&normal, &tangential, &kinetic}) out = grainscope::write_components(*part, out);
  const grainscope::Plane &plane = scope_.shear_plane();
  const int a = plane.flow, b = plane.gradient, v = plane.vorticity;
  const double pressure = scope_.pressure_of(total, domain->dimension);
  const double per_pressure = pressure > 0.0 ? 1.0 / pressure : 0.0;
  const double of_grains = all.contacts_of_grains(), with_walls = all.contacts_with_walls();
  const double per_contact = all.contacts() > 0.0 ? 1.0 / all.contacts() : 0.0;
  *out++ = pressure;
  *out++ = total(a, b) * per_pressure;
  *out++ = (total(a, a) - total(b, b)) * per_pressure;
  *out++ = box.dimension == 2 ? 0.0 : (total(b, b) - total(v, v)) * per_pressure;
  *out++ = of_grains;
  *out++ = motion.grains > 0.0 ? (2.0 * of_grains + with_walls) / motion.grains : 0.0;
  *out++ = all.sliding() * per_contact;
  *out++ = all.overlaps() * per_contact;
  *out++ = largest_overlap;
  if (impl_->watch.renewed(*neighbor, *update)) {
    const double depth = box.dimension == 2 ? mean_diameter() : 1.0;
    stiffness_ = flattest_shape() * std::pow(softest_modulus() * depth, 2.0 / 3.0);
  }
  const bool is_whole = scope_.type_pair().any();  // the pressure of some contacts tells nothing of the grains
  const double kappa = is_whole ? stiffness_ * std::pow(per_pressure, 2.0 / 3.0) : 0.0;
  *out++ = kappa;
  *out++ = with_walls;
  require_all_elements(out);
  if (!unasked())
    soft_.watch(lmp, is_whole && pressure > 0.0 && kappa < hard_grains,
                ("compute stress/contact " + std::string(id) +
                 ": the stiffness number kappa is %.4g, below the hard-grain limit of %g: results depend on the "
                 "stiffness of the grains. Use stiffer grains or a lower pressure")
                    .c_str(),
                kappa, hard_grains);
  for (int k = 0; k < size_vector; k++) vector[k] += 0.0;  // no negative zeros
  if (!grainscope::all_finite(vector, size_vector))
    error->all(FLERR, ("compute stress/contact: the stress of step " + std::to_string(update->ntimestep) +
                       " is not finite, though every force is: check overlaps and material properties")
                          .c_str());
  scalar = pressure + 0.0;
  if (impl_->of_types) put_rows(unit);
}

/** `unit`: pressure per sum of forces times lengths. */
void ComputeStressContact::put_rows(double unit) {
  const std::vector<std::pair<int, int>> pairs = impl_->of_types->pairs().all();
  const std::vector<grainscope::StressSums> rows = impl_->of_types->total(*this);
  for (std::size_t row = 0; row < rows.size(); row++) {
    const grainscope::StressSums &sums = rows[row];
    const Eigen::Matrix3d s = sums.total(1.0) * unit + Eigen::Matrix3d::Zero();  // no negative zeros
    put_row(row, {static_cast<double>(pairs[row].first), static_cast<double>(pairs[row].second), s(0, 0), s(1, 1),
                  s(2, 2), s(0, 1), s(0, 2), s(1, 2), s(1, 0), sums.contacts_of_grains(), sums.contacts_with_walls(),
                  sums.sliding()});
  }
}

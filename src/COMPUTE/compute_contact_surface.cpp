// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_contact_surface.h"
#include "arguments.h"
#include "contact_measures.h"
#include "contact_observer.h"
#include "contact_sums.h"
#include "ellipsoid_bands.h"
#include "grain_shape.h"
#include "neighbour_list_watch.h"
#include "symmetry_axis.h"
#include "atom.h"
#include "domain.h"
#include "force.h"
#include "group.h"
#include "neighbor.h"
#include "update.h"
#include <algorithm>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;
using Eigen::Map;
using Eigen::Vector3d;
using grainscope::Contact;
using grainscope::Shape;
using grainscope::SurfaceAngle;

namespace {

constexpr auto intensive = grainscope::Extent::intensive, whole = grainscope::Extent::whole;

/** Sums over the contacts of one bin: each grain of a contact adds its own. */
enum { CONTACTS, NORMAL, TANGENTIAL, MOBILISATION, SLIDING, NORMAL_POWER, FRICTION_POWER, SUMS };

grainscope::Outputs declared(int bins) {
  grainscope::Outputs outputs;
  outputs.vector = {{"P", "pressure", intensive,
                     "pressure of all contacts of the group, those with walls too, which forces are divided by"},
                    {"A_p", "distance^2", intensive, "area of a grain, mean over the group"},
                    {"N", "-", whole, "grains of the group"}};
  outputs.set_array(bins, "bin of psi",
                    {{"psi", "rad", intensive, "angle of the bin's middle"},
                     {"area", "distance^2", intensive, "area A_j of the bin on a grain, mean over grains"},
                     {"N_c", "-", whole, "contacts N_j of the bin, each on both of its grains, with a wall on one"},
                     {"rho_s", "1/distance^2", intensive, "share of the contacts over the area A_j"},
                     {"rho_s_A_p", "-", intensive, "rho_s A_p = (N_j/N)/(A_j/A_p)"},
                     {"F_n", "-", intensive, "F_n/(P A_p), mean over the bin's contacts"},
                     {"F_t", "-", intensive, "|F_t|/(P A_p), mean over the bin's contacts"},
                     {"mobilisation", "-", intensive, "|F_t| over its friction limit, mean over the bin's contacts"},
                     {"sliding", "-", intensive, "fraction of the bin's contacts that slide"},
                     {"P_n", "energy/time", whole, "power lost by normal damping, half to each grain of a contact"},
                     {"P_t", "energy/time", whole, "power lost by friction, half to each grain of a contact"},
                     {"inhomogeneity", "-", intensive, "share of P_n + P_t over share of the area"},
                     {"inhomogeneity_printed", "-", intensive, "the same, as the paper prints it"},
                     {"F_n_sum", "-", whole, "sum of which F_n is the mean"},
                     {"F_t_sum", "-", whole, "sum of which F_t is the mean"},
                     {"mobilisation_sum", "-", whole, "sum of which mobilisation is the mean"},
                     {"sliding_sum", "-", whole, "the bin's contacts that slide"}});
  return outputs;
}

/** v seen along body axis `axis`: that component last, the others before it. */
Vector3d along(int axis, const Vector3d &v) { return {v[(axis + 1) % 3], v[(axis + 2) % 3], v[axis]}; }

void require_axes(const Atom *atom, const Domain *domain, const grainscope::Arguments &errors) {
  if (domain->dimension == 2)
    errors.fail("needs three dimensions, got 'dimension 2': discs have no axes to measure angles from");
  if (!atom->superquadric_flag)
    errors.fail("needs atom_style superquadric, got '" + std::string(atom->atom_style) +
                "': other grains have no axes to measure angles from");
}

/** Sums of each bin, over the contacts of this rank; a grain's angle is measured from `axis`. */
struct SurfaceSums {
  const Atom *atom = nullptr;
  int bins = 10;
  SurfaceAngle angle = SurfaceAngle::polar;
  int axis = -1;             // body axis; -1: the symmetry axis
  double unit_area = 0.0;    // of a grain whose semi-axis along the axis is 1
  std::vector<double> sums;  // bins x SUMS, contacts whose place is not finite

  void reset() { sums.assign(bins * SUMS + 1, 0.0); }
  std::vector<double> &numbers() { return sums; }
  const double *bin(int k) const { return &sums[k * SUMS]; }
  double not_finite() const { return sums.back(); }

  /** The body axis that angles are measured from: z for spheres. */
  int axis_of(const double *shape) const {
    if (axis >= 0) return axis;
    const int symmetry = grainscope::symmetry_axis(shape).index;
    return symmetry < 0 ? 2 : symmetry;
  }
  void add(const Contact &c) {
    const Vector3d arm = c.motion->point - Map<const Vector3d>(atom->x[c.i]);
    add_to(c.i, arm, c);
    if (c.with_own_grain()) add_to(c.j(), arm + c.branch, c);  // a ghost's owner counts it
  }
  void add_to(int grain, const Vector3d &arm, const Contact &c) {
    const double *shape = atom->shape[grain];
    const int from = axis_of(shape);
    const Vector3d point = along(from, grainscope::orientation(*atom, grain).conjugate() * arm);
    const double psi = grainscope::surface_angle(point, along(from, Map<const Vector3d>(shape)), angle);
    const int band = grainscope::band_of(psi, bins);
    if (band < 0) sums.back() += c.weight;
    else add_to_bin(&sums[band * SUMS], c, unit_area * shape[from] * shape[from]);
  }
  static void add_to_bin(double *s, const Contact &c, double area) {
    s[CONTACTS] += 1.0;
    s[NORMAL] += c.normal_force / area;
    s[TANGENTIAL] += c.tangential_force.norm() / area;
    s[MOBILISATION] += grainscope::mobilisation(c);
    s[SLIDING] += c.sliding ? 1.0 : 0.0;
    const double share = c.with_wall() ? 1.0 : 0.5;
    s[NORMAL_POWER] += share * grainscope::damping_loss(c);
    s[FRICTION_POWER] += share * grainscope::friction_loss(c);
  }
};

/** The pressure by which forces are divided is that of all contacts, whichever are counted in bins. */
struct PressureSum : grainscope::ContactCompute::Accumulator {
  Vector3d moments = Vector3d::Zero();  // sums of F_a r_a, of this rank

  void reset() override { moments.setZero(); }
  void add(grainscope::ContactSpan contacts, const grainscope::ContactCompute &of) override {
    grainscope::ContactCompute::Selection all = of.selection();
    all.walls = grainscope::Walls::yes;
    all.narrow = false;
    const grainscope::RegionSolid *const region = of.scope().within();
    grainscope::for_each_contact(contacts, all, [this, region](const Contact &c) {
      const Vector3d to = c.motion->point - c.motion->arm;  // the centre of i
      const double share = region ? c.weight * region->part(to - c.branch, to) : c.weight;
      moments += share * c.force.cwiseProduct(c.branch);
    });
  }
};

}

struct ComputeContactSurface::Impl {
  grainscope::ContactSums<SurfaceSums> contacts;
  PressureSum pressure;
  // semi-axes of a grain of the group's shape, 1 along the axis; zero for an empty group
  Vector3d proportions = Vector3d::Zero();
  std::vector<double> unit_areas;          // of its bands
  double grains = 0.0, mean_square = 0.0;  // of the group: number, mean of (semi-axis along the axis)^2
  grainscope::NeighbourListWatch watch;    // of the grains that the four above are of

  SurfaceSums &sums() { return contacts.mine(); }
};

ComputeContactSurface::ComputeContactSurface(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : ContactCompute(lmp, iarg, narg, arg,
                     grainscope::Scope::region | grainscope::Scope::types | grainscope::Scope::walls |
                         grainscope::Scope::pressure | grainscope::Scope::volume,
                     grainscope::Walls::no),
      impl_(new Impl) {
  grainscope::Arguments arguments(lmp, name_, iarg, narg, arg);
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword(scope_.with({"bins", "angle", "axis"}));
    scope_.read(arguments, keyword);
    if (keyword == "bins") impl_->sums().bins = arguments.whole_number(keyword, 1, 1000);
    if (keyword == "angle")
      impl_->sums().angle = arguments.choice(keyword, {"polar", "parametric"}) == "polar" ? SurfaceAngle::polar
                                                                                          : SurfaceAngle::parametric;
    if (keyword == "axis") {
      const std::string axis = arguments.choice(keyword, {"auto", "x", "y", "z"});
      impl_->sums().axis = axis == "auto" ? -1 : axis[0] - 'x';
    }
  }
  require_axes(atom, domain, arguments);
  impl_->sums().atom = atom;
  sums_over(impl_->contacts);
  sums_over(impl_->pressure);
  declare(this, declared(impl_->sums().bins));
}

ComputeContactSurface::~ComputeContactSurface() {}

void ComputeContactSurface::init() {
  require_axes(atom, domain, grainscope::Arguments(lmp, name_));
  grainscope::require_no_bodies(lmp, grainscope::Arguments(lmp, name_), "their surface is not that of their spheres");
  ContactCompute::init();
  require_known_losses();
  require_one_shape();
  impl_->watch = grainscope::NeighbourListWatch();
}

/** Ellipsoids of one shape, of any size. Collective. */
void ComputeContactSurface::require_one_shape() {
  const grainscope::Arguments errors(lmp, name_);
  const int none = std::numeric_limits<int>::max();
  int boxy = none, triaxial = none;
  // largest and (negative) smallest ratios of semi-axes across to along
  double extremes[4] = {0.0, 0.0, -HUGE_VAL, -HUGE_VAL};
  for (int i = 0; i < atom->nlocal; i++) {
    if (!in_group(i)) continue;
    const double *shape = atom->shape[i], *blockiness = atom->blockiness[i];
    if (blockiness[0] != 2.0 || blockiness[1] != 2.0) boxy = std::min(boxy, atom->tag[i]);
    if (impl_->sums().axis < 0 && grainscope::symmetry_axis(shape).shape == Shape::triaxial)
      triaxial = std::min(triaxial, atom->tag[i]);
    const Vector3d s = along(impl_->sums().axis_of(shape), Map<const Vector3d>(shape));
    for (int k = 0; k < 2; k++) {
      extremes[k] = std::max(extremes[k], s[k] / s[2]);
      extremes[2 + k] = std::max(extremes[2 + k], -s[k] / s[2]);
    }
  }
  int bad[2] = {boxy, triaxial};
  MPI_Allreduce(MPI_IN_PLACE, bad, 2, MPI_INT, MPI_MIN, world);
  MPI_Allreduce(MPI_IN_PLACE, extremes, 4, MPI_DOUBLE, MPI_MAX, world);
  if (bad[0] != none)
    errors.fail("needs ellipsoids, blockiness 2 2, got another blockiness of grain " + std::to_string(bad[0]));
  if (bad[1] != none)
    errors.fail("'axis' must be x, y or z for triaxial grains, got 'auto' and grain " + std::to_string(bad[1]));
  if (extremes[0] == 0.0) {  // nobody in the group
    impl_->proportions = Vector3d::Zero();
    impl_->unit_areas.assign(impl_->sums().bins, 0.0);
    impl_->sums().unit_area = 0.0;
    return;
  }
  for (int k = 0; k < 2; k++)
    if (extremes[k] + extremes[2 + k] > 1e-9 * extremes[k])
      errors.fail("needs grains of one shape in group '" + std::string(group->names[igroup]) +
                  "', got ratios of the semi-axes across and along the axis from " + std::to_string(-extremes[2 + k]) +
                  " to " + std::to_string(extremes[k]));
  const Vector3d proportions(extremes[0], extremes[1], 1.0);
  if (proportions != impl_->proportions) {
    impl_->proportions = proportions;
    impl_->unit_areas = grainscope::band_areas(proportions, impl_->sums().bins, impl_->sums().angle);
  }
  impl_->sums().unit_area = 0.0;
  for (double area : impl_->unit_areas) impl_->sums().unit_area += area;
}

/** What depends on the grains in the group, which come and go with neighbour lists and between runs. Collective. */
void ComputeContactSurface::measure_grains() {
  if (!impl_->watch.renewed(*neighbor, *update)) return;
  require_one_shape();
  double sums[2] = {0.0, 0.0};
  for (int i = 0; i < atom->nlocal; i++) {
    if (!in_group(i)) continue;
    const double size = atom->shape[i][impl_->sums().axis_of(atom->shape[i])];
    sums[0] += 1.0;
    sums[1] += size * size;
  }
  sum_over_ranks(sums, 2);
  impl_->grains = sums[0];
  impl_->mean_square = sums[0] > 0.0 ? sums[1] / sums[0] : 0.0;
}

void ComputeContactSurface::begin_contacts() {
  measure_grains();
  ContactCompute::begin_contacts();
}

void ComputeContactSurface::answer() {
  observer_->require_complete(name_ + " " + id);  // the pressure needs walls, whatever the bins count
  const SurfaceSums &all = impl_->contacts.total(*this);
  require_finite(all.not_finite());
  Vector3d stress = impl_->pressure.moments / -scope_.volume_now(observer_->box());
  sum_over_ranks(stress.data(), 3);
  const double pressure = scope_.pressure_of(Eigen::Matrix3d(stress.asDiagonal()), domain->dimension);
  const double per_pressure = pressure > 0.0 ? 1.0 / pressure : 0.0;
  double contacts = 0.0, power = 0.0;
  for (int k = 0; k < all.bins; k++) {
    contacts += all.bin(k)[CONTACTS];
    power += all.bin(k)[NORMAL_POWER] + all.bin(k)[FRICTION_POWER];
  }
  for (int k = 0; k < all.bins; k++) {
    const double *s = all.bin(k);
    const double area = impl_->unit_areas[k] * impl_->mean_square;
    const double whole_over_part = all.unit_area > 0.0 ? all.unit_area / impl_->unit_areas[k] : 0.0;
    const double share = contacts > 0.0 ? s[CONTACTS] / contacts : 0.0,
                 per_contact = s[CONTACTS] > 0.0 ? 1.0 / s[CONTACTS] : 0.0;
    const double inhomogeneity = power != 0.0 ? (s[NORMAL_POWER] + s[FRICTION_POWER]) / power * whole_over_part : 0.0;
    put_row(k, {(k + 0.5) * M_PI_2 / all.bins, area, s[CONTACTS], area > 0.0 ? share / area : 0.0,
                share * whole_over_part, s[NORMAL] * per_contact * per_pressure,
                s[TANGENTIAL] * per_contact * per_pressure, s[MOBILISATION] * per_contact, s[SLIDING] * per_contact,
                s[NORMAL_POWER], s[FRICTION_POWER], inhomogeneity, inhomogeneity * whole_over_part,
                s[NORMAL] * per_pressure, s[TANGENTIAL] * per_pressure, s[MOBILISATION], s[SLIDING]});
  }
  put_vector({pressure * force->nktv2p, all.unit_area * impl_->mean_square, impl_->grains});
}

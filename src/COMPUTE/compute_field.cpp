// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_field.h"
#include "arguments.h"
#include "contact_measures.h"
#include "contact_observer.h"
#include "contact_sums.h"
#include "field_gradient.h"
#include "grain_shape.h"
#include "requirements.h"
#include "symmetric_tensor.h"
#include "atom.h"
#include "domain.h"
#include "force.h"
#include "group.h"
#include "update.h"
#include <algorithm>

using namespace LAMMPS_NS;
using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using grainscope::Contact;
using grainscope::FieldQuantities;
using grainscope::FieldSums;
using grainscope::Scope;

namespace {

constexpr auto whole = grainscope::Extent::whole;
const std::vector<std::string> usual = {"density", "velocity", "stress"};

/** F_a r_b, row by row. */
void add_dyad(double *to, double weight, const Vector3d &f, const Vector3d &r) {
  Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(to) += weight * f * r.transpose();
}

}

ComputeField::ComputeField(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : ContactCompute(lmp, iarg, narg, arg, Scope::types | Scope::walls | Scope::axis),
      quantities_(read(iarg, narg, arg)) {
  grainscope::Outputs outputs;
  outputs.scalar = {{"cells", "-", whole, "cells that hold grains"}};
  outputs.vector = {{"N_total", "-", whole, "grains in cells"},
                    {"M_total", "mass", whole, "their mass"},
                    {"V_total", "volume", whole, "volume of all cells"},
                    {"N_outside", "-", whole, "grains of the group that no cell knows"}};
  outputs.set_array(settings_.cells(), "cell, x fastest", quantities_.columns(settings_.are_rings()));
  declare(this, outputs);
}

FieldQuantities ComputeField::read(int &iarg, int narg, char **arg) {
  grainscope::Arguments arguments(lmp, name_, iarg, narg, arg);
  std::vector<std::string> words = grainscope::FieldSettings::keywords(), names = usual;
  words.push_back("quantities");
  words = scope_.with(words);
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword(words);
    if (scope_.read(arguments, keyword) || settings_.read(arguments, keyword)) continue;
    names = arguments.words_before(words, "the names of quantities");
  }
  if (names == std::vector<std::string>{"all"}) names = FieldQuantities::names(domain->dimension);
  settings_.complete(arguments);
  grainscope::require_grains(lmp, arguments);
  return FieldQuantities(arguments, names);
}

void ComputeField::init() {
  ContactCompute::init();
  const grainscope::Arguments errors(lmp, name_);
  grainscope::require_no_bodies(lmp, errors, "each of their spheres would count as a grain");
  settings_.require_dimension(errors, domain->dimension);
  if (domain->dimension == 2 && (quantities_.blocks() & FieldSums::axes))
    errors.fail("Q, S2 and director need dimension 3");
  if (quantities_.blocks() & FieldSums::losses) require_known_losses();
  const grainscope::BoxState box(lmp);
  settings_.find_region(lmp, name_);
  settings_.fix_radii(box);
  settings_.require_cells(errors, box);
  map_ = settings_.map(box);
}

/** If no quantity needs contacts, none are read. */
bool ComputeField::wants_contacts() {
  if (!ContactCompute::wants_contacts()) return false;
  if (quantities_.need_contacts()) return true;
  begin(grainscope::BoxState(lmp));
  return false;
}

void ComputeField::begin_contacts() {
  ContactCompute::begin_contacts();
  begin(observer_->box());
}

void ComputeField::begin(const grainscope::BoxState &box) {
  answered_ = false;
  not_finite_ = 0.0;
  box_ = box;
  settings_.find_region(lmp, name_);  // it may be another since a run that was not set up
  map_ = settings_.map(box);
  if (sums_.cells() == 0) sums_ = FieldSums(quantities_.blocks(), map_.cells().count());
  sums_.reset();
}

bool ComputeField::reads_motion() const { return quantities_.need_contacts(); }

void ComputeField::add_contacts(grainscope::ContactSpan contacts) {
  grainscope::for_each_contact(contacts, selection(), [this](const Contact &c) { add_contact(c); });
}

void ComputeField::add_contact(const Contact &c) {
  const Vector3d &point = c.motion->point;
  if (!point.allFinite() || !c.branch.allFinite()) {
    not_finite_ += 1.0;
    return;
  }
  const Vector3d centre = point - c.motion->arm;  // of i
  if (sums_.has(FieldSums::force) || sums_.has(FieldSums::tangential)) add_branch(c, centre);
  if (sums_.has(FieldSums::ends)) {
    const auto add_end = [this](int cell, double weight, const Vector3d &) {
      *sums_.of(FieldSums::ends, cell) += weight;
    };
    map_.for_each_at(centre, add_end);
    if (c.with_own_grain()) map_.for_each_at(centre - c.branch, add_end);
  }
  constexpr unsigned of_points =
      FieldSums::contacts | FieldSums::overlaps | FieldSums::losses | FieldSums::fabric | FieldSums::traction;
  if (!(quantities_.blocks() & of_points)) return;
  map_.for_each_at(point, [&](int cell, double weight, const Vector3d &boxes) {
    weight *= c.weight;
    if (sums_.has(FieldSums::contacts)) sums_.of(FieldSums::contacts, cell)[c.with_wall() ? 1 : 0] += weight;
    if (sums_.has(FieldSums::overlaps)) *sums_.of(FieldSums::overlaps, cell) += weight * c.overlap;
    if (sums_.has(FieldSums::losses)) {
      double *const losses = sums_.of(FieldSums::losses, cell);
      losses[0] += weight * grainscope::damping_loss(c);
      losses[1] += weight * grainscope::friction_loss(c);
      losses[2] += weight * grainscope::tangential_damping_loss(c);
    }
    const bool pushes = c.with_wall() && sums_.has(FieldSums::traction);
    if (!sums_.has(FieldSums::fabric) && !pushes) return;
    const Matrix3d frame = map_.cells().frame(point + box_.edges * boxes);
    if (pushes) Map<Vector3d>(sums_.of(FieldSums::traction, cell)) += weight * (frame * c.force);
    if (!sums_.has(FieldSums::fabric)) return;
    const Vector3d n = frame * c.normal;
    grainscope::add_components(sums_.of(FieldSums::fabric, cell), weight, grainscope::dyad(n, n));
  });
}

void ComputeField::add_branch(const Contact &c, const Vector3d &centre) {
  map_.for_each_along(centre - c.branch, centre, [&](int cell, double share, const Vector3d &middle) {
    Vector3d r = c.branch, force = c.force, tangential = c.tangential_force;
    if (map_.cells().are_rings()) {
      const Matrix3d frame = map_.cells().frame(middle);
      r = frame * r;
      force = frame * force;
      tangential = frame * tangential;
    }
    if (sums_.has(FieldSums::force)) add_dyad(sums_.of(FieldSums::force, cell), share * c.weight, force, r);
    if (sums_.has(FieldSums::tangential))
      add_dyad(sums_.of(FieldSums::tangential, cell), share * c.weight, tangential, r);
  });
}

/** The share of a grain in a cell. */
struct ComputeField::Share {
  int cell;
  double weight;
  Vector3d at;        // of the image that the cell sees
  Matrix3d frame;     // that components are along
  Vector3d velocity;  // components
};

/** Calls use(share) for each cell that sees grain i; false without any. */
template <class Use>
bool ComputeField::for_each_share(int i, const Use &use) const {
  const Vector3d x = Map<const Vector3d>(atom->x[i]), v = Map<const Vector3d>(atom->v[i]);
  bool seen = false;
  map_.for_each_at(x, [&](int cell, double weight, const Vector3d &boxes) {
    seen = true;
    const Vector3d at = x + box_.edges * boxes;
    const Matrix3d frame = map_.cells().frame(at);
    use(Share{cell, weight, at, frame, frame * (v + box_.edge_velocities * boxes)});
  });
  return seen;
}

void ComputeField::add_grain(int i) {
  const double mass = grainscope::mass_of(*atom, i);
  const grainscope::SymmetryAxis kind = axis_of(i);
  const bool oriented = kind.index >= 0;
  Vector3d axis = Vector3d::Zero();
  if (oriented) axis = grainscope::orientation(*atom, i) * Vector3d::Unit(kind.index);
  const bool seen = for_each_share(i, [&](const Share &s) {
    *sums_.of(FieldSums::grains, s.cell) += s.weight;
    *sums_.of(FieldSums::mass, s.cell) += s.weight * mass;
    if (sums_.has(FieldSums::solid))
      *sums_.of(FieldSums::solid, s.cell) += s.weight * grainscope::solid_volume(*atom, i, domain->dimension);
    if (sums_.has(FieldSums::momentum))
      Map<Vector3d>(sums_.of(FieldSums::momentum, s.cell)) += s.weight * mass * s.velocity;
    if (sums_.has(FieldSums::spin))
      Map<Vector3d>(sums_.of(FieldSums::spin, s.cell)) += s.weight * (s.frame * Map<const Vector3d>(atom->omega[i]));
    if (sums_.has(FieldSums::centroid))
      Map<Vector3d>(sums_.of(FieldSums::centroid, s.cell)) +=
          s.weight * mass * (map_.cells().position(s.at) - map_.cells().middle(s.cell));
    if (!oriented) return;
    const Vector3d p = s.frame * axis;
    grainscope::add_components(sums_.of(FieldSums::axes, s.cell), s.weight, grainscope::dyad(p, p));
    sums_.of(FieldSums::axes, s.cell)[6] += s.weight;
  });
  if (!seen) outside_ += 1.0;
  if (!seen || !oriented) return;
  with_axis_ += 1.0;
  if (kind.shape == grainscope::Shape::oblate) flat_ += 1.0;
}

/** The axis that represents grain i, if one is needed; index -1 if it has none. */
grainscope::SymmetryAxis ComputeField::axis_of(int i) const {
  if (!atom->superquadric_flag || !sums_.has(FieldSums::axes)) return {grainscope::Shape::sphere, -1};
  return grainscope::chosen_axis(atom->shape[i], scope_.axis_choice());
}

/** For grains relative to the mean motion about each cell, which must be known. */
void ComputeField::add_motion() {
  const grainscope::FieldMotion mean(map_, sums_, settings_.wraps(box_), settings_.jumps(box_));
  FieldSums mine(FieldSums::motion, sums_.cells());
  for (int i = 0; i < atom->nlocal; i++) {
    if (!in_group(i)) continue;
    const double mass = grainscope::mass_of(*atom, i);
    for_each_share(i, [&](const Share &s) {
      const Vector3d dv = s.velocity - mean.velocity(s.cell, map_.cells().position(s.at));
      grainscope::add_components(mine.of(FieldSums::motion, s.cell), s.weight * mass, grainscope::dyad(dv, dv));
    });
  }
  sum_over_ranks(mine.numbers().data(), static_cast<int>(mine.numbers().size()));
  for (int cell = 0; cell < sums_.cells(); cell++)
    std::copy_n(mine.of(FieldSums::motion, cell), 6, sums_.of(FieldSums::motion, cell));
}

void ComputeField::warn_of_mixture() {
  if (!sums_.has(FieldSums::axes) || !scope_.axis_is_automatic()) return;
  double counts[2] = {flat_, with_axis_};
  sum_over_ranks(counts, 2);
  mixture_.warn(lmp, name_, group->names[igroup], counts[0], counts[1]);
}

void ComputeField::answer() {
  if (answered_) return;
  answered_ = true;
  sum_over_ranks(&not_finite_, 1);
  require_finite(not_finite_);
  outside_ = flat_ = with_axis_ = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    if (in_group(i)) add_grain(i);
  sum_over_ranks(sums_.numbers().data(), static_cast<int>(sums_.numbers().size()));
  sum_over_ranks(&outside_, 1);
  for (int cell = 0; cell < sums_.cells(); cell++) *sums_.of(FieldSums::volume, cell) = map_.cells().volume(cell);
  if (sums_.has(FieldSums::motion)) add_motion();
  warn_of_mixture();

  double grains = 0.0, mass = 0.0, volume = 0.0, filled = 0.0;
  for (int cell = 0; cell < sums_.cells(); cell++) {
    const Vector3d middle = map_.cells().middle(cell);
    double *const begin = array[cell], *const end = quantities_.write(sums_, cell, 1.0, units(),
                                                                      std::copy_n(middle.data(), 3, begin));
    require_all_columns(begin, end);
    grains += *sums_.of(FieldSums::grains, cell);
    mass += *sums_.of(FieldSums::mass, cell);
    volume += *sums_.of(FieldSums::volume, cell);
    if (*sums_.of(FieldSums::grains, cell) > 0.0) filled += 1.0;
  }
  scalar = filled;
  put_vector({grains, mass, volume, outside_});
}

grainscope::FieldUnits ComputeField::units() const {
  grainscope::FieldUnits units;
  units.pressure = force->nktv2p;
  units.kinetic = force->mvv2e * force->nktv2p;
  units.dimension = domain->dimension;
  return units;
}

double ComputeField::memory_usage() {
  return array_bytes() + 2.0 * sizeof(double) * const_cast<FieldSums &>(sums_).numbers().capacity();
}

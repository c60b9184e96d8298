// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluctuations.h"
#include "arguments.h"
#include "grain_shape.h"
#include "momentum_flux.h"
#include "region_solid.h"
#include "require_finite.h"
#include "symmetric_tensor.h"
#include "atom.h"
#include "domain.h"
#include "lammps.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <mpi.h>
#include <sstream>
#include <utility>

namespace grainscope {

using Eigen::Map;
using Eigen::Vector3d;

namespace {

const double rounding = 1e-12;  // of sums of squares

void sum_over_ranks(const LAMMPS_NS::LAMMPS *lmp, double *values, int n) {
  MPI_Allreduce(MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_SUM, lmp->world);
}

}

void require_layers(LAMMPS_NS::LAMMPS *lmp, const std::string &who, double grains) {
  require_finite(lmp, who, grains, "the positions",
                 "grains are not finite, so they belong to no layer: check what moves or pushes them");
}

void MeanFlow::read(Arguments &arguments) {
  const std::vector<std::string> names = {"box", "none", "rate", "fit", "gradient", "layers", "cells"};
  const std::string name = arguments.choice("flow", names);
  kind = static_cast<Kind>(std::find(names.begin(), names.end(), name) - names.begin());
  if (kind == Kind::rate) rate = arguments.number("flow rate", "a shear rate", [](double) { return true; });
  if (kind == Kind::layers) layers = arguments.whole_number("flow layers", 1, 10000);
  if (kind == Kind::cells)
    for (int &number : cells) number = arguments.whole_number("flow cells", 1, 1000);
}

std::string MeanFlow::text() const {
  std::ostringstream all;
  all.precision(17);
  all << static_cast<int>(kind) << ' ' << rate << ' ' << layers << ' ' << plane.flow << plane.gradient;
  if (kind == Kind::cells) all << ' ' << cells[0] << ' ' << cells[1] << ' ' << cells[2];
  return all.str();
}

/** The same, clumps as one grain each. */
template <class Flow>
void Fluctuations::collect_with_bodies(const ChosenGrains &chosen, Flow flow) {
  const LAMMPS_NS::Atom *atom = lmp_->atom;
  for (int i = 0, n = atom->nlocal; i < n; i++) {
    if (!(atom->mask[i] & chosen.groupbit) || !bodies_.stands_for_itself_or_clump(i)) continue;
    Grain grain = {i, 0, mass_of(*atom, i), Vector3d::Zero(), bodies_.of(i)};
    const Vector3d x = place(grain);
    if (chosen.region && !chosen.region->has(x)) continue;
    if (grain.body) grain.mass = grain.body->mass;
    grain.u = (grain.body ? grain.body->velocity : Vector3d(Map<const Vector3d>(atom->v[i]))) - flow(x);
    local_.push_back(grain);
  }
}

/** The grains of the group, with what their velocity has beside flow(x). */
template <class Flow>
inline void Fluctuations::collect(const ChosenGrains &chosen, Flow flow) {
  if (bodies_.any()) return collect_with_bodies(chosen, flow);
  const LAMMPS_NS::Atom *atom = lmp_->atom;
  local_.resize(atom->nlocal);
  Grain *grain = local_.data();
  for (int i = 0, n = atom->nlocal; i < n; i++) {
    if (!(atom->mask[i] & chosen.groupbit)) continue;
    if (chosen.region && !chosen.region->has(Map<const Vector3d>(atom->x[i]))) continue;
    *grain++ = {i, 0, mass_of(*atom, i), Map<const Vector3d>(atom->v[i]) - flow(Map<const Vector3d>(atom->x[i])),
                nullptr};
  }
  local_.resize(grain - local_.data());
}

Fluctuations::Fluctuations(LAMMPS_NS::LAMMPS *lmp, const ChosenGrains &chosen, const BoxState &box)
    : lmp_(lmp), bodies_(lmp, chosen.who), means_(1) {
  bodies_.update(box, chosen.groupbit);
  const AffineFlow affine = box;  // a copy, which no store of a grain may change
  collect(chosen, [&affine](const Vector3d &x) { return affine.flow(x); });
  find_mean_velocity();
}

Fluctuations::Fluctuations(LAMMPS_NS::LAMMPS *lmp, const ChosenGrains &chosen, const BoxState &box,
                           const MeanFlow &flow)
    : lmp_(lmp), bodies_(lmp, chosen.who), means_(flow.means()) {
  bodies_.update(box, chosen.groupbit);
  switch (flow.kind) {
    case MeanFlow::Kind::box:
    case MeanFlow::Kind::layers:
    case MeanFlow::Kind::cells: collect(chosen, [&](const Vector3d &x) { return box.flow(x); }); break;
    case MeanFlow::Kind::rate: collect(chosen, [&](const Vector3d &x) { return shear(flow, box, x); }); break;
    case MeanFlow::Kind::none:
    case MeanFlow::Kind::fit:
    case MeanFlow::Kind::gradient:
      collect(chosen, [](const Vector3d &) { return Vector3d(Vector3d::Zero()); });
      if (flow.kind == MeanFlow::Kind::fit) subtract_line(flow.plane.gradient);
      if (flow.kind == MeanFlow::Kind::gradient) subtract_gradient();
      break;
  }
  if (flow.means() > 1) find_layers(box, flow);
  find_means();
}

Fluctuations::Fluctuations(LAMMPS_NS::LAMMPS *lmp, const std::string &who, std::vector<Grain> moved,
                           std::vector<Vector3d> places, const BoxState &box, const MeanFlow &flow)
    : lmp_(lmp), bodies_(lmp, who), local_(std::move(moved)), places_(std::move(places)), means_(flow.means()) {
  if (flow.kind == MeanFlow::Kind::rate)
    for (Grain &g : local_) g.u -= shear(flow, box, place(g));
  if (flow.kind == MeanFlow::Kind::fit) subtract_line(flow.plane.gradient);
  if (flow.kind == MeanFlow::Kind::gradient) subtract_gradient();
  if (flow.means() > 1) find_layers(box, flow);
  find_means();
}

/** The given rate's, at x. */
Vector3d Fluctuations::shear(const MeanFlow &flow, const BoxState &box, const Vector3d &x) {
  Vector3d along = Vector3d::Zero();
  along[flow.plane.flow] = flow.rate * (x[flow.plane.gradient] - box.centre[flow.plane.gradient]);
  return along;
}

Vector3d Fluctuations::own_spin(const Grain &grain) const {
  return grain.body ? grain.body->spin : Vector3d(Map<const Vector3d>(lmp_->atom->omega[grain.index]));
}

Vector3d Fluctuations::place(const Grain &grain) const {
  if (!places_.empty()) return places_[grain.index];
  return grain.body ? grain.body->centre : Vector3d(Map<const Vector3d>(lmp_->atom->x[grain.index]));
}

double Fluctuations::rotational_energy(const Grain &grain, const Vector3d &w) const {
  return grain.body ? grain.body->rotational_energy(w)
                    : grainscope::rotational_energy(*lmp_->atom, grain.index, lmp_->domain->dimension, w);
}

double Fluctuations::equivalent_diameter(const Grain &grain) const {
  return grain.body ? std::cbrt(6.0 / M_PI * grain.body->volume)
                    : grainscope::equivalent_diameter(*lmp_->atom, grain.index);
}

void Fluctuations::find_layers(const BoxState &box, const MeanFlow &flow) {
  std::array<int, 3> cells{{1, 1, 1}};
  if (flow.kind == MeanFlow::Kind::cells) cells = flow.cells;
  else cells[flow.plane.gradient] = flow.layers;
  double outside = 0.0;
  for (Grain &g : local_) {
    const Vector3d x = place(g);
    const std::array<int, 3> at{{box.layer(x, 0, cells[0]), box.layer(x, 1, cells[1]), box.layer(x, 2, cells[2])}};
    g.layer = std::min({at[0], at[1], at[2]}) < 0 ? -1 : at[0] + cells[0] * (at[1] + cells[1] * at[2]);
    if (g.layer < 0) outside += 1.0;
  }
  sum_over_ranks(lmp_, &outside, 1);
  require_layers(lmp_, flow.kind == MeanFlow::Kind::cells ? "flow cells" : "flow layers", outside);
}

/** For all grains, without their spins: the pressure uses it in every step. */
void Fluctuations::find_mean_velocity() {
  double mass = 0.0;
  Vector3d momentum = Vector3d::Zero();
  for (const Grain &g : local_) {
    momentum += g.mass * g.u;
    mass += g.mass;
  }
  double sums[5] = {momentum[0], momentum[1], momentum[2], mass, static_cast<double>(local_.size())};
  sum_over_ranks(lmp_, sums, 5);
  grains_ = sums[4];
  if (sums[3] > 0.0) means_[0].velocity = Map<const Vector3d>(sums) / sums[3];
}

void Fluctuations::find_means() {
  std::vector<double> sums(8 * means_.size(), 0.0);  // per layer: m u, m, omega, grains
  for (const Grain &g : local_) {
    double *at = &sums[8 * g.layer];
    Map<Vector3d>(at + 0) += g.mass * g.u;
    at[3] += g.mass;
    Map<Vector3d>(at + 4) += own_spin(g);
    at[7] += 1.0;
  }
  sum_over_ranks(lmp_, sums.data(), sums.size());
  for (std::size_t k = 0; k < means_.size(); k++) {
    const double *at = &sums[8 * k];
    if (at[7] == 0.0) continue;
    grains_ += at[7];
    means_[k] = {Map<const Vector3d>(at + 0) / at[3], Map<const Vector3d>(at + 4) / at[7]};
  }
}

Eigen::Matrix3d Fluctuations::momentum_flux() const {
  double sums[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  for (const Grain &g : local_) {
    const Vector3d dv = velocity(g), p = g.mass * dv;
    add_components(sums, dyad(p, dv));
  }
  sum_over_ranks(lmp_, sums, 6);
  return symmetric_tensor(sums);
}

MomentumFlux MomentumFlux::of(LAMMPS_NS::LAMMPS *lmp, const ChosenGrains &chosen, const BoxState &box) {
  const LAMMPS_NS::Atom &atom = *lmp->atom;
  constexpr int all = 1;
  if (chosen.groupbit != all || chosen.region || !atom.rmass || has_bodies(lmp)) {
    const Fluctuations motion(lmp, chosen, box);
    return {motion.momentum_flux(), motion.grains()};
  }
  const MovingGrains grains{atom.nlocal, atom.x[0], atom.v[0], atom.rmass};
  const std::array<double, 4> momentum = momentum_of(grains, box);
  double sums[5] = {momentum[0], momentum[1], momentum[2], momentum[3], static_cast<double>(atom.nlocal)};
  sum_over_ranks(lmp, sums, 5);
  Vector3d mean = Vector3d::Zero();
  if (sums[3] > 0.0) mean = Map<const Vector3d>(sums) / sums[3];
  SixComponents flux = momentum_flux_of(grains, box, mean);
  sum_over_ranks(lmp, flux.data(), 6);
  return {symmetric_tensor(flux.data()), sums[4]};
}

/** Subtracts the gradient that fits best: v = u + L (x - <x>), least squares by mass. If grains do not extend along an
 *  axis, as in two dimensions, nothing is known along it: the smallest gradient that fits. */
void Fluctuations::subtract_gradient() {
  double first[7] = {};  // m x, m v, m
  for (const Grain &g : local_) {
    Map<Vector3d>(first + 0) += g.mass * place(g);
    Map<Vector3d>(first + 3) += g.mass * g.u;
    first[6] += g.mass;
  }
  sum_over_ranks(lmp_, first, 7);
  if (first[6] == 0.0) return;
  const Vector3d middle = Map<Vector3d>(first + 0) / first[6], mean = Map<Vector3d>(first + 3) / first[6];

  double second[18] = {};  // m dx dx, m du dx, in columns
  for (const Grain &g : local_) {
    const Vector3d dx = place(g) - middle;
    Map<Eigen::Matrix3d>(second + 0) += g.mass * dx * dx.transpose();
    Map<Eigen::Matrix3d>(second + 9) += g.mass * (g.u - mean) * dx.transpose();
  }
  sum_over_ranks(lmp_, second, 18);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread{Eigen::Matrix3d(Map<Eigen::Matrix3d>(second + 0))};
  Vector3d inverse = Vector3d::Zero();
  for (int k = 0; k < 3; k++)
    if (spread.eigenvalues()[k] > rounding * spread.eigenvalues()[2]) inverse[k] = 1.0 / spread.eigenvalues()[k];
  gradient_ = Map<Eigen::Matrix3d>(second + 9) * spread.eigenvectors() * inverse.asDiagonal() *
              spread.eigenvectors().transpose();
  for (Grain &g : local_) g.u -= gradient_ * (place(g) - middle);
}

/** Subtracts the slope of the fitted line; its height is subtracted with the mean. */
void Fluctuations::subtract_line(int gradient) {
  double first[5] = {};  // m y, m v, m
  for (const Grain &g : local_) {
    first[0] += g.mass * place(g)[gradient];
    Map<Vector3d>(first + 1) += g.mass * g.u;
    first[4] += g.mass;
  }
  sum_over_ranks(lmp_, first, 5);
  if (first[4] == 0.0) return;
  const double middle = first[0] / first[4];
  const Vector3d mean = Map<Vector3d>(first + 1) / first[4];

  double second[4] = {};  // m (y - <y>)(v - <v>), m (y - <y>)^2
  for (const Grain &g : local_) {
    const double y = place(g)[gradient] - middle;
    Map<Vector3d>(second + 0) += g.mass * y * (g.u - mean);
    second[3] += g.mass * y * y;
  }
  sum_over_ranks(lmp_, second, 4);
  if (second[3] == 0.0) return;
  slope_ = Map<Vector3d>(second + 0) / second[3];
  for (Grain &g : local_) g.u -= slope_ * (place(g)[gradient] - middle);
}

}

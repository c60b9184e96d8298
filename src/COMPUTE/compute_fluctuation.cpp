// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_fluctuation.h"
#include "arguments.h"
#include "fluctuations.h"
#include "range_warning.h"
#include "requirements.h"
#include "scope.h"
#include "atom.h"
#include "domain.h"
#include "update.h"
#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using Eigen::Map;
using Eigen::Vector3d;
using grainscope::BoxState;
using grainscope::Fluctuations;
using grainscope::MeanFlow;

namespace {

const char *const name = "compute fluctuation";
constexpr auto intensive = grainscope::Extent::intensive, extensive = grainscope::Extent::extensive;
constexpr auto whole = grainscope::Extent::whole;

const int sums_of_layer = 5;  // mass, grains, momentum

// A third of what a flow has that is sheared in one thin layer only, 1/(2 sqrt 3).
const double straight_enough = 0.1;

/** Axes that grains spin about. */
int spins_of(int dimension) { return dimension == 2 ? 1 : 3; }

bool is_positive(double x) { return x > 0.0; }

grainscope::Outputs declared(int layers) {
  grainscope::Outputs outputs;
  const grainscope::NamedOutput lever = {"lever", "-", intensive, "lever effect, rms |dv| over |rate| d_eq"};
  outputs.scalar = {lever};
  outputs.vector.add_each("x y z", {"dv_*", "velocity", intensive, "rms of the velocity's fluctuation dv_*"})
      .add_each("x y z", {"dw_*", "1/time", intensive, "rms of the angular velocity's fluctuation dw_*"})
      .add({"E_tr", "energy", extensive, "translational energy of the fluctuations"})
      .add({"E_rot", "energy", extensive, "rotational energy of the fluctuations"})
      .add({"E_ratio", "-", intensive, "E_rot/E_tr"})
      .add(lever)
      .add({"rate", "1/time", intensive, "shear rate of the box"})
      .add({"rate_measured", "1/time", intensive, "shear rate of the grains"})
      .add({"deviation", "-", intensive, "deviation of the velocity profile from the box's flow, over |rate| L"})
      .add({"deviation_by_chance", "-", intensive, "deviation expected from noise alone"})
      .add_each("x y z", {"T_*", "velocity^2", intensive, "granular temperature *, sum m dv_*^2 over sum m"})
      .add({"T", "velocity^2", intensive, "translational granular temperature, mean of those of the axes"})
      .add({"T_rot", "velocity^2", intensive,
            "rotational granular temperature, sum dw.J dw over 3 sum m, in two dimensions over sum m"})
      .add({"lever_measured", "-", intensive, "rms |dv| over |rate_measured| d_eq"})
      .add({"N_grains", "-", whole, "grains"})
      .add_each("xx xy xz yx yy yz zx zy zz",
                {"L_*", "1/time", intensive, "velocity gradient L_* of 'flow gradient', dv_a/dx_b"});
  grainscope::OutputList columns = {
      {"position", "distance", intensive, "middle of the layer along the gradient, from the box centre"},
      {"N", "-", whole, "grains of the layer"}};
  columns.add_each("x y z", {"u_*", "velocity", intensive, "mean velocity * by mass relative to the flow of the box"});
  outputs.set_array(layers, "layer", columns);
  return outputs;
}

}

struct ComputeFluctuation::Impl {
  grainscope::RangeWarning bent;
  explicit Impl(LAMMPS *lmp) : scope(lmp, name, grainscope::Scope::region) {}
  grainscope::Scope scope;
  MeanFlow flow;
  int layers = 10;
  double diameter = 0.0;  // 0: the mean of the group

  MeanFlow with(MeanFlow::Kind kind) const {
    MeanFlow other = flow;
    other.kind = kind;
    return other;
  }
};

ComputeFluctuation::ComputeFluctuation(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : Compute(lmp, iarg, narg, arg), impl_(new Impl(lmp)) {
  grainscope::Arguments arguments(lmp, name, iarg, narg, arg);
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword(impl_->scope.with({"plane", "layers", "diameter", "flow"}));
    impl_->scope.read(arguments, keyword);
    if (keyword == "plane") impl_->flow.plane.read(arguments);
    if (keyword == "layers") impl_->layers = arguments.whole_number(keyword, 1, 10000);
    if (keyword == "diameter") impl_->diameter = arguments.number(keyword, "a positive length", is_positive);
    if (keyword == "flow") impl_->flow.read(arguments);
  }
  grainscope::require_grains(lmp, arguments);
  declare(this, declared(impl_->layers));
}

ComputeFluctuation::~ComputeFluctuation() {}

void ComputeFluctuation::init() {
  grainscope::require_grains(lmp, grainscope::Arguments(lmp, name));
  impl_->scope.init();
  grainscope::require_known_bodies(lmp, name);
}

void ComputeFluctuation::compute_array() {
  invoked_array = update->ntimestep;
  const BoxState box(lmp);
  impl_->scope.update(box);
  const int across = impl_->flow.plane.gradient;
  const Fluctuations motion(lmp, {name, groupbit, impl_->scope.within()}, box, impl_->with(MeanFlow::Kind::box));
  // Per layer m, grains, m u; then grains that no layer holds.
  std::vector<double> sums(sums_of_layer * impl_->layers + 1, 0.0);
  for (const Fluctuations::Grain &g : motion.local()) {
    const int layer = box.layer(motion.place(g), across, impl_->layers);
    if (layer < 0) {
      sums.back() += 1.0;
      continue;
    }
    double *at = &sums[sums_of_layer * layer];
    at[0] += g.mass;
    at[1] += 1.0;
    Map<Vector3d>(at + 2) += g.mass * motion.velocity(g);
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), sums.size(), MPI_DOUBLE, MPI_SUM, world);
  grainscope::require_layers(lmp, name, sums.back());
  const double length = box.edges(across, across);
  for (int k = 0; k < impl_->layers; k++) {
    const double *at = &sums[sums_of_layer * k];
    const Vector3d mean = at[0] > 0.0 ? Vector3d(Map<const Vector3d>(at + 2) / at[0]) : Vector3d::Zero();
    put_row(k, {((k + 0.5) / impl_->layers - 0.5) * length, at[1], mean[0], mean[1], mean[2]});
  }
}

void ComputeFluctuation::compute_vector() {
  invoked_vector = update->ntimestep;
  const BoxState box(lmp);
  impl_->scope.update(box);
  const int along = impl_->flow.plane.flow, across = impl_->flow.plane.gradient;
  const Fluctuations motion(lmp, {name, groupbit, impl_->scope.within()}, box, impl_->flow);
  double sums[13] = {};  // dv dv, dw dw, twice E_tr, E_rot, diameters, m dv dv, m
  for (const Fluctuations::Grain &g : motion.local()) {
    const Vector3d dv = motion.velocity(g), dw = motion.spin(g);
    Map<Vector3d>(sums + 0) += dv.cwiseAbs2();
    Map<Vector3d>(sums + 3) += dw.cwiseAbs2();
    sums[6] += g.mass * dv.squaredNorm();
    sums[7] += motion.rotational_energy(g, dw);
    sums[8] += motion.equivalent_diameter(g);
    Map<Vector3d>(sums + 9) += g.mass * dv.cwiseAbs2();
    sums[12] += g.mass;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 13, MPI_DOUBLE, MPI_SUM, world);
  std::fill(vector, vector + size_vector, 0.0);
  scalar = 0.0;
  const double n = motion.grains();
  if (n == 0.0) return;

  for (int k = 0; k < 6; k++) vector[k] = std::sqrt(sums[k] / n);
  vector[6] = 0.5 * sums[6];
  vector[7] = sums[7];
  vector[8] = vector[6] > 0.0 ? vector[7] / vector[6] : 0.0;
  vector[10] = box.velocity_gradient(along, across);
  vector[11] =
      Fluctuations(lmp, {name, groupbit, impl_->scope.within()}, box, impl_->with(MeanFlow::Kind::fit)).slope()[along];
  for (int k = 0; k < 3; k++) vector[14 + k] = sums[9 + k] / sums[12];
  vector[17] = (vector[14] + vector[15] + vector[16]) / domain->dimension;
  vector[18] = 2.0 * sums[7] / (spins_of(domain->dimension) * sums[12]);
  const double diameter = impl_->diameter > 0.0 ? impl_->diameter : sums[8] / n;
  const double speed = std::sqrt((sums[0] + sums[1] + sums[2]) / n);
  if (vector[11] != 0.0) vector[19] = speed / (std::fabs(vector[11]) * diameter);
  vector[20] = n;
  for (int k = 0; k < 9; k++) vector[21 + k] = motion.gradient()(k / 3, k % 3);
  const double rate = std::fabs(vector[10]);
  if (rate == 0.0) return;
  scalar = vector[9] = speed / (rate * diameter);

  compute_array();
  double squares = 0.0, layers = 0.0;
  for (int k = 0; k < impl_->layers; k++) {
    squares += array[k][2 + along] * array[k][2 + along];
    layers += array[k][1] > 0.0 ? 1.0 : 0.0;
  }
  const double unit = rate * box.edges(across, across);
  vector[12] = std::sqrt(squares / layers) / unit;
  vector[13] = vector[along] * std::sqrt(layers / n) / unit;
  const double limit = std::max(straight_enough, 2.0 * vector[13]);
  impl_->bent.watch(lmp, vector[12] > limit,
                    "compute fluctuation: the velocity profile deviates from the box's flow by %.3g of rate x L (rms "
                    "over layers; limit %g; a flow in one thin layer has 0.29), so that this deviation is counted as "
                    "fluctuation. Look for a shear band, or use 'flow layers'",
                    vector[12], limit);
}

double ComputeFluctuation::compute_scalar() {
  invoked_scalar = update->ntimestep;
  if (invoked_vector != update->ntimestep) compute_vector();
  return scalar;
}

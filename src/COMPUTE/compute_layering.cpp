// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_layering.h"
#include "arguments.h"
#include "fluctuations.h"
#include "two_dimensions.h"
#include "atom.h"
#include "update.h"
#include <algorithm>
#include <cmath>
#include <vector>

using namespace LAMMPS_NS;

namespace {

const char *const name = "compute layering";
constexpr auto intensive = grainscope::Extent::intensive, whole = grainscope::Extent::whole;

grainscope::Outputs declared(int lags) {
  grainscope::Outputs outputs;
  outputs.scalar = {{"order", "-", intensive, "peak over C0"}};
  outputs.vector = {{"peak", "1/distance", intensive, "largest C beyond lag 0"},
                    {"peak_lag", "distance", intensive, "its lag"},
                    {"C0", "1/distance", intensive, "C at lag 0"},
                    {"N", "-", whole, "grains"}};
  outputs.set_array(
      lags, "lag",
      {{"lag", "distance", intensive, "lag y"}, {"C", "1/distance", intensive, "correlation of the density"}});
  return outputs;
}

}

struct ComputeLayering::Impl {
  int axis = 1;
  int layers = 40;
  double grains = 0.0;
};

ComputeLayering::ComputeLayering(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : Compute(lmp, iarg, narg, arg), impl_(new Impl) {
  grainscope::Arguments arguments(lmp, name, iarg, narg, arg);
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword({"axis", "layers"});
    if (keyword == "axis") {
      const std::string axis = arguments.choice(keyword, {"x", "y", "z"});
      grainscope::require_axes_of_plane(lmp, arguments, keyword, "x or y", axis);
      impl_->axis = axis[0] - 'x';
    } else impl_->layers = arguments.even_number(keyword, 2, 1000);
  }
  declare(this, declared(impl_->layers / 2 + 1));
}

ComputeLayering::~ComputeLayering() {}

void ComputeLayering::init() { grainscope::require_known_bodies(lmp, name); }

void ComputeLayering::compute_array() {
  invoked_array = update->ntimestep;
  const grainscope::BoxState box(lmp);
  const int m = impl_->layers;
  std::vector<double> counts(m + 1, 0.0);  // of each layer; then grains that none holds
  grainscope::Bodies bodies(lmp, name);
  bodies.update(box, groupbit);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit) || !bodies.stands_for_itself_or_clump(i)) continue;
    const Eigen::Vector3d x = Eigen::Map<const Eigen::Vector3d>(atom->x[i]) - bodies.arm(i);
    const int layer = box.layer(x, impl_->axis, m);
    counts[layer < 0 ? m : layer] += 1.0;
  }
  MPI_Allreduce(MPI_IN_PLACE, counts.data(), m + 1, MPI_DOUBLE, MPI_SUM, world);
  grainscope::require_layers(lmp, name, counts[m]);
  counts.pop_back();
  impl_->grains = 0.0;
  for (double count : counts) impl_->grains += count;

  // dn = (count - N/m) m/V, so that A/(n m) dn dn = (m/L) (count - N/m)(count' - N/m)/N.
  const double height = box.height(impl_->axis), mean = impl_->grains / m;
  for (int lag = 0; lag <= m / 2; lag++) {
    double products = 0.0;
    for (int k = 0; k < m; k++) products += (counts[k] - mean) * (counts[(k + lag) % m] - mean);
    put_row(lag, {lag * height / m, impl_->grains > 0.0 ? products * m / (height * impl_->grains) : 0.0});
  }
}

void ComputeLayering::compute_vector() {
  invoked_vector = update->ntimestep;
  compute_array();
  std::fill(vector, vector + size_vector, 0.0);
  scalar = 0.0;
  if (impl_->grains == 0.0) return;
  int peak = 1;
  for (int lag = 2; lag < size_array_rows; lag++)
    if (array[lag][1] > array[peak][1]) peak = lag;
  const double highest = array[peak][1], at_zero = array[0][1];
  put_vector({highest, array[peak][0], at_zero, impl_->grains});
  scalar = at_zero > 0.0 ? highest / at_zero : 0.0;
}

double ComputeLayering::compute_scalar() {
  invoked_scalar = update->ntimestep;
  if (invoked_vector != update->ntimestep) compute_vector();
  return scalar;
}

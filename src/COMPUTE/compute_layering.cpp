// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_layering.h"
#include "arguments.h"
#include "fluctuations.h"
#include "rows.h"
#include "atom.h"
#include "update.h"
#include <algorithm>
#include <cmath>
#include <vector>

using namespace LAMMPS_NS;

struct ComputeLayering::Impl {
  int axis = 1;
  int layers = 40;
  double grains = 0.0;
  grainscope::Rows rows;
};

ComputeLayering::ComputeLayering(LAMMPS *lmp, int &iarg, int narg, char **arg) : Compute(lmp, iarg, narg, arg), impl_(new Impl) {
  grainscope::Arguments arguments(lmp, "compute layering", iarg, narg, arg);
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword({"axis", "layers"});
    if (keyword == "axis") impl_->axis = arguments.choice(keyword, {"x", "y", "z"})[0] - 'x';
    else impl_->layers = arguments.even_number(keyword, 2, 1000);
  }
  scalar_flag = vector_flag = array_flag = 1;
  extscalar = extvector = extarray = 0;
  size_vector = 4;
  vector = new double[size_vector]();
  size_array_rows = impl_->layers / 2 + 1;
  size_array_cols = 2;
  array = impl_->rows.resize(size_array_rows, size_array_cols);
}

ComputeLayering::~ComputeLayering() { delete[] vector; }

void ComputeLayering::init() {}

void ComputeLayering::compute_array() {
  invoked_array = update->ntimestep;
  const grainscope::BoxState box(lmp);
  const int m = impl_->layers;
  std::vector<double> counts(m + 1, 0.0);  // of each layer; then grains that none holds
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const int layer = box.layer(Eigen::Map<const Eigen::Vector3d>(atom->x[i]), impl_->axis, m);
    counts[layer < 0 ? m : layer] += 1.0;
  }
  MPI_Allreduce(MPI_IN_PLACE, counts.data(), m + 1, MPI_DOUBLE, MPI_SUM, world);
  grainscope::require_layers(lmp, "compute layering", counts[m]);
  counts.pop_back();
  impl_->grains = 0.0;
  for (double count : counts) impl_->grains += count;

  // dn = (count - N/m) m/V, so that A/(n m) dn dn = (m/L) (count - N/m)(count' - N/m)/N.
  const double height = box.height(impl_->axis), mean = impl_->grains / m;
  for (int lag = 0; lag <= m / 2; lag++) {
    double products = 0.0;
    for (int k = 0; k < m; k++) products += (counts[k] - mean) * (counts[(k + lag) % m] - mean);
    array[lag][0] = lag * height / m;
    array[lag][1] = impl_->grains > 0.0 ? products * m / (height * impl_->grains) : 0.0;
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
  vector[0] = array[peak][1];
  vector[1] = array[peak][0];
  vector[2] = array[0][1];
  vector[3] = impl_->grains;
  scalar = vector[2] > 0.0 ? vector[0] / vector[2] : 0.0;
}

double ComputeLayering::compute_scalar() {
  invoked_scalar = update->ntimestep;
  if (invoked_vector != update->ntimestep) compute_vector();
  return scalar;
}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "bin_index.h"
#include "ellipsoid_bands.h"
#include "input.h"
#include "lag_mesh.h"
#include <algorithm>

using namespace grainscope;
using fuzz::require;

namespace {

/** A place in bins: any double, or one near an edge. */
double place(fuzz::Input &input, int bins) {
  if (input.flag()) return input.any();
  return input.whole(-2, std::min(bins, 60000) + 2) + 1e-3 * input.small();
}

void check_bins(double at, int bins) {
  const int exact = bin_index(at, bins), other = bin_index(at, bins, bins), nearest = nearest_bin_index(at, bins);
  const bool inside = at >= 0.0 && at < bins;
  require(inside ? exact <= at && at < exact + 1.0 && exact < bins : exact == -1, "inside a bin, or refused", at, bins);
  require(other == (inside ? exact : bins), "what is refused has the index that was asked for", at, bins);
  if (std::isnan(at)) require(nearest == -1, "what is no number has no bin", at);
  else require(nearest == (inside ? exact : at < 0.0 ? 0 : bins - 1), "the nearest bin", at, bins);
}

void check_places(fuzz::Input &input) {
  LagMesh mesh;
  PointValues points;
  for (int k = 0; k < 3; k++) mesh.size[k] = input.whole(1, 50);
  mesh.row = 2 * (mesh.size[2] / 2 + 1);
  const Eigen::Vector3d s(input.any(), input.any(), input.any());
  points.add(s, 1.0);
  const std::array<int, 3> cell = mesh.cell_of(points, 0);
  for (int k = 0; k < 3; k++)
    require(std::isfinite(s[k]) ? cell[k] >= 0 && cell[k] < mesh.size[k] : cell[k] == -1, "a cell of the mesh, or none",
            s[k], mesh.size[k]);
  const int bands = input.whole(1, 1000);
  const double psi = input.any();
  const int band = band_of(psi, bands);
  require(std::isnan(psi) ? band == -1 : band >= 0 && band < bands, "a band, or none", psi, bands);
}

}

/** Whatever a double is, it becomes an index that is in range, or none. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzz::Input input(data, size);
  const int bins = input.flag() ? input.whole(1, 40) : 1 + static_cast<int>(input.logarithmic(1.0, 2e9));
  check_bins(place(input, bins), bins);
  const double value = input.any(), most = input.logarithmic(1.0, 9e15);
  const long long whole = whole_count(value, most);
  const bool taken = value >= 0.0 && value <= most && value == std::floor(value);
  require(taken ? value == static_cast<double>(whole) : whole == -1, "a whole number, or refused", value, most);
  check_places(input);
  return 0;
}

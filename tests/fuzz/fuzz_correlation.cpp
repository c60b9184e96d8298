// SPDX-License-Identifier: GPL-2.0-or-later
#include "input.h"
#include "lag_mesh.h"
#include "pair_correlation.h"
#include <algorithm>
#include <stdexcept>

using namespace grainscope;
using Eigen::Vector3d;
using fuzz::require;
using fuzz::require_below;

namespace {

PeriodicCell cell_of(fuzz::Input &input) {
  PeriodicCell cell;
  cell.edges.setZero();
  for (int k = 0; k < 3; k++) {
    cell.edges(k, k) = input.logarithmic(0.3, 3.0);
    cell.periodic[k] = input.byte() % 4 != 0;
  }
  // Tilts up to half an edge: farther the host turns the box back.
  cell.edges(0, 1) = 0.5 * input.small() * cell.edges(0, 0);
  cell.edges(0, 2) = 0.5 * input.small() * cell.edges(0, 0);
  cell.edges(1, 2) = 0.5 * input.small() * cell.edges(1, 1);
  return cell;
}

/** Shortest of all images, by trying them. */
double distance(const PeriodicCell &cell, const Vector3d &s) {
  Vector3d rounded = s;
  int most[3];
  for (int k = 0; k < 3; k++) {
    if (cell.periodic[k]) rounded[k] -= std::nearbyint(s[k]);
    most[k] = cell.periodic[k] ? 1 + static_cast<int>((cell.edges * rounded).norm() / cell.height(k)) : 0;
  }
  double shortest = HUGE_VAL;
  for (int a = -most[0]; a <= most[0]; a++)
    for (int b = -most[1]; b <= most[1]; b++)
      for (int c = -most[2]; c <= most[2]; c++)
        shortest = std::min(shortest, (cell.edges * (rounded + Vector3d(a, b, c))).norm());
  return shortest;
}

/** Pairs in each bin are as many as there are; where a distance is that of an edge, it may be in either. */
void check_pairs(const PeriodicCell &cell, const PointValues &points, const DistanceBins &bins, const PairSums &sums) {
  std::vector<double> surely(bins.count + 1, 0.0), perhaps(bins.count + 1, 0.0);  // nearer than the end of bin k
  for (std::size_t i = 0; i < points.size(); i++)
    for (std::size_t j = 0; j < i; j++) {
      const Vector3d s(points.s[0][i] - points.s[0][j], points.s[1][i] - points.s[1][j],
                       points.s[2][i] - points.s[2][j]);
      const double r = distance(cell, s), rounding = 1e-9;
      for (int k = 0; k < bins.count; k++) {
        surely[k] += r < (k + 1) * bins.width() - rounding;
        perhaps[k] += r < (k + 1) * bins.width() + rounding;
      }
    }
  double nearer = 0.0;
  for (int k = 0; k < bins.count; k++) {
    nearer += sums.pairs[k];
    require(nearer >= surely[k] && nearer <= perhaps[k], "every pair is in its bin", nearer);
    require_below(std::fabs(sums.products[0][k]), 4.0 * sums.pairs[k] + 1e-9, "products are as large as values are");
  }
}

/** Two ranks see what one sees, and the order of points does not matter. */
void check_shares(const PeriodicCell &cell, const PointValues &points, const DistanceBins &bins, const PairSums &sums) {
  const PairSums first = direct_pair_sums(cell, points, bins, 0, 2),
                 second = direct_pair_sums(cell, points, bins, 1, 2);
  for (int k = 0; k < bins.count; k++) {
    require(first.pairs[k] + second.pairs[k] == sums.pairs[k], "ranks share all pairs", sums.pairs[k]);
    require_below(std::fabs(first.products[0][k] + second.products[0][k] - sums.products[0][k]), 1e-10,
                  "ranks share all products");
  }
}

/** A correlation of 1 at every lag: as many as there are cells within range. */
void check_mesh(const PeriodicCell &cell, const PointValues &points, const DistanceBins &bins) {
  LagMesh mesh{};
  try {
    mesh.size = mesh_size(cell, bins, 1, 4000.0);
  } catch (const std::length_error &) {
    return;
  }
  mesh.planes = mesh.size[0];
  mesh.row = 2 * (mesh.size[2] / 2 + 1);
  for (std::size_t i = 0; i < points.size(); i++) {
    const std::array<int, 3> at = mesh.cell_of(points, i);
    for (int k = 0; k < 3; k++) {
      const int least = std::isfinite(points.s[k][i]) ? 0 : -1;
      require(at[k] >= least && at[k] < mesh.size[k], "a point is in a cell", at[k]);
    }
  }
  const std::vector<double> ones(mesh.planes * mesh.size[1] * mesh.row, 1.0);
  std::vector<double> lags(bins.count, 0.0);
  add_lags(cell, mesh, ones.data(), true, bins, lags);
  double all = 0.0;
  for (double lag : lags) all += lag;
  require(lags[0] >= 1.0 && all <= static_cast<double>(mesh.size[0]) * mesh.size[1] * mesh.size[2], "lags are cells",
          all);
}

}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzz::Input input(data, size);
  PeriodicCell cell = cell_of(input);
  const DistanceBins bins{input.logarithmic(0.01, 10.0), input.whole(1, 20)};
  PointValues points, lost;
  const bool crowd = input.flag();  // enough of them for a grid of cells
  for (int n = input.whole(0, crowd ? 90 : 12); n > 0; n--) {
    // beyond the box too: a grain may have left it since it was last wrapped
    const double wide = input.flag() ? 1.0 : 2.0;
    points.add(Vector3d(input.uniform(0.0, wide), input.uniform(0.0, wide), input.uniform(0.0, 1.0)),
               2.0 * input.small());
  }
  const PairSums sums = direct_pair_sums(cell, points, bins);
  check_pairs(cell, points, bins, sums);
  check_shares(cell, points, bins, sums);

  lost = points;  // of a run that has blown up
  lost.add(Vector3d(input.any(), input.any(), input.any()), input.any());
  direct_pair_sums(cell, lost, bins);
  PeriodicCell torn = cell;
  torn.edges(0, input.whole(0, 2)) = HUGE_VAL;
  direct_pair_sums(torn, lost, bins);
  torn.edges *= std::nan("");
  direct_pair_sums(torn, lost, {std::nan(""), bins.count});
  cell.periodic = {{true, true, true}};
  check_mesh(cell, lost, bins);
  return 0;
}

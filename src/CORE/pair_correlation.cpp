// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_correlation.h"
#include <algorithm>
#include <cmath>

namespace grainscope {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr int batch = 256;  // distances at a time, a multiple of the lanes
constexpr int lanes = 4;    // sums side by side: one that waits for the last to be stored takes half as long again

struct Span {
  std::size_t begin, end;
};

/** A grid on the unit cube that sorts points, so that pairs within range lie in neighbouring cells. An edge along which
 *  all cells would be neighbours is not divided. */
class Grid {
 public:
  Grid(const PeriodicCell &cell, double range, std::size_t points) : periodic_(cell.periodic) {
    const int most = std::max(1, static_cast<int>(std::cbrt(points / 8.0)));
    for (int k = 0; k < 3; k++) {
      const double heights = range / cell.height(k), reach = heights < 1e3 ? heights : 1e3;  // farther is everywhere
      n_[k] = static_cast<int>(std::min<double>(most, std::max(1.0, 2.0 / reach)));
      reach_[k] = static_cast<int>(std::ceil(reach * n_[k]));
      if (2 * reach_[k] + 1 >= n_[k]) n_[k] = 1;
    }
  }

  int cells() const { return n_[0] * n_[1] * n_[2]; }

  /** -1 for a place that is not finite. */
  int cell_of(const PointValues &points, std::size_t i) const {
    int at[3];
    for (int k = 0; k < 3; k++) {
      double s = points.s[k][i];
      if (periodic_[k]) s -= std::floor(s);
      at[k] = cell_along(s, n_[k]);
      if (at[k] < 0) return -1;
    }
    return index(at);
  }

  /** The points in the neighbours of cell `me` that come after it, in order. */
  void neighbours_after(int me, const std::vector<std::size_t> &first, std::vector<Span> &spans) const {
    const int at[3] = {me / (n_[1] * n_[2]), me / n_[2] % n_[1], me % n_[2]};
    std::vector<int> along[3], found;
    for (int k = 0; k < 3; k++) along[k] = neighbours_along(k, at[k]);
    for (int a : along[0])
      for (int b : along[1])
        for (int c : along[2]) {
          const int other[3] = {a, b, c};
          if (index(other) > me) found.push_back(index(other));
        }
    std::sort(found.begin(), found.end());
    spans.clear();
    for (int other : found) {
      if (!spans.empty() && spans.back().end == first[other]) spans.back().end = first[other + 1];
      else spans.push_back({first[other], first[other + 1]});
    }
  }

 private:
  std::array<bool, 3> periodic_;
  int n_[3], reach_[3];

  int index(const int at[3]) const { return (at[0] * n_[1] + at[1]) * n_[2] + at[2]; }

  std::vector<int> neighbours_along(int k, int at) const {
    std::vector<int> found;
    if (n_[k] == 1) return {0};
    for (int other = at - reach_[k]; other <= at + reach_[k]; other++) {
      if (periodic_[k]) found.push_back((other + n_[k]) % n_[k]);
      else if (other >= 0 && other < n_[k]) found.push_back(other);
    }
    return found;
  }
};

/** Points in the order of their cells; cell c holds those from first[c] to first[c + 1]. Those whose place is not
 *  finite are left out. */
PointValues sorted(const PointValues &points, const Grid &grid, std::vector<std::size_t> &first) {
  const std::size_t n = points.size();
  std::vector<int> cell(n);
  first.assign(grid.cells() + 1, 0);
  for (std::size_t i = 0; i < n; i++)
    if ((cell[i] = grid.cell_of(points, i)) >= 0) first[cell[i] + 1]++;
  for (int c = 0; c < grid.cells(); c++) first[c + 1] += first[c];
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  PointValues out;
  for (auto *column : {&out.s[0], &out.s[1], &out.s[2], &out.value}) column->resize(first.back());
  for (std::size_t i = 0; i < n; i++) {
    if (cell[i] < 0) continue;
    const std::size_t to = next[cell[i]]++;
    for (int k = 0; k < 3; k++) out.s[k][to] = points.s[k][i];
    out.value[to] = points.value[i];
  }
  return out;
}

/** Adds up the pairs of one point with the others of a span. */
class RowSums {
 public:
  RowSums(const PeriodicCell &cell, const PointValues &points, const DistanceBins &bins)
      : cell_(cell), images_(cell, bins.range), points_(points), bins_(bins.count),
        per_length_(bins.count / bins.range), row_(lanes * (bins.count + 1), Vector2d::Zero()) {
    for (int k = 0; k < 3; k++) wrap_[k] = cell.periodic[k] ? 1.0 : 0.0;
  }

  void add(std::size_t i, Span others) {
    for (std::size_t j = others.begin; j < others.end; j += batch) {
      const int n = static_cast<int>(std::min<std::size_t>(batch, others.end - j));
      squared_distances(i, j, n);
      images_.lower(n, x_, y_, z_, r2_);
      to_bins(n);
      add_batch(&points_.value[j], n);
    }
  }

  /** Moves what was added for point i to `sums`. */
  void flush(std::size_t i, PairSums &sums) {
    for (int k = 0; k < bins_; k++) {
      Vector2d all = Vector2d::Zero();
      for (int lane = 0; lane < lanes; lane++) all += row_[lane * (bins_ + 1) + k];
      sums.products[k] += points_.value[i] * all[0];
      sums.pairs[k] += all[1];
    }
    std::fill(row_.begin(), row_.end(), Vector2d::Zero());
  }

 private:
  const PeriodicCell &cell_;
  NearestImages images_;
  const PointValues &points_;
  int bins_;
  double per_length_;
  double wrap_[3];
  // sum of values and pairs: per lane, of each bin; the last bin holds what is out of range
  std::vector<Vector2d> row_;
  double x_[batch], y_[batch], z_[batch], r2_[batch];
  int bin_[batch];

  void squared_distances(std::size_t i, std::size_t j, int n) {
    const double *sx = &points_.s[0][j], *sy = &points_.s[1][j], *sz = &points_.s[2][j];
    const double x = points_.s[0][i], y = points_.s[1][i], z = points_.s[2][i];
    const Eigen::Matrix3d &h = cell_.edges;
    const double xx = h(0, 0), xy = h(0, 1), xz = h(0, 2), yy = h(1, 1), yz = h(1, 2), zz = h(2, 2);
    const double wx = wrap_[0], wy = wrap_[1], wz = wrap_[2];
    const double rounder = 6755399441055744.0;  // 1.5 2^52: adding and taking it off rounds to the nearest whole number
    for (int m = 0; m < n; m++) {
      double a = sx[m] - x, b = sy[m] - y, c = sz[m] - z;
      a -= wx * ((a + rounder) - rounder);
      b -= wy * ((b + rounder) - rounder);
      c -= wz * ((c + rounder) - rounder);
      x_[m] = xx * a + xy * b + xz * c;
      y_[m] = yy * b + yz * c;
      z_[m] = zz * c;
      r2_[m] = x_[m] * x_[m] + y_[m] * y_[m] + z_[m] * z_[m];
    }
  }

  void to_bins(int n) {
    for (int m = 0; m < n; m++) bin_[m] = bin_index(std::sqrt(r2_[m]) * per_length_, bins_, bins_);
  }

  void add_batch(const double *value, int n) {
    Vector2d *lane[lanes];
    for (int k = 0; k < lanes; k++) lane[k] = &row_[k * (bins_ + 1)];
    int m = 0;
    for (; m + lanes <= n; m += lanes)
      for (int k = 0; k < lanes; k++) {
        Vector2d &at = lane[k][bin_[m + k]];
        at[0] += value[m + k];
        at[1] += 1.0;
      }
    for (; m < n; m++) lane[0][bin_[m]] += Vector2d(value[m], 1.0);
  }
};

}

void PointValues::add(const Vector3d &fraction, double v) {
  for (int k = 0; k < 3; k++) s[k].push_back(fraction[k]);
  value.push_back(v);
}

PairSums direct_pair_sums(const PeriodicCell &cell, const PointValues &points, const DistanceBins &bins, int rank,
                          int ranks) {
  const Grid grid(cell, bins.range, points.size());
  std::vector<std::size_t> first;
  const PointValues ordered = sorted(points, grid, first);
  PairSums sums(bins.count);
  RowSums row(cell, ordered, bins);
  std::vector<Span> spans;
  for (int c = 0; c < grid.cells(); c++) {
    grid.neighbours_after(c, first, spans);
    for (std::size_t i = first[c]; i < first[c + 1]; i++) {
      if (static_cast<int>(i % ranks) != rank) continue;
      row.add(i, {i + 1, first[c + 1]});
      for (const Span &span : spans) row.add(i, span);
      row.flush(i, sums);
    }
  }
  return sums;
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_correlation.h"
#include "lanes.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace grainscope {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// All lengths in this file are in widths of a bin, so that the whole part of a distance is its bin.
namespace {

constexpr int batch = 512;  // points at a time, a multiple of LANES
// Sums side by side, two for each lane in turn: one that waits for the last to be stored takes half as long again.
constexpr int tables = 2 * LANES;
constexpr double slack = 1.0 + 1e-9;     // of lengths that say where to look, beyond rounding
constexpr double outward = 1.0 + 1e-12;  // two images that are both at the end of the range are both out of it

constexpr int SETS = PointValues::MOST_SETS;
static_assert(SETS + 1 == LANES, "a row of the table is products of all sets and the number of pairs");

/** Positions x of a group of points, or x in units of the edges, and their values, 0 of a set that is not there; with
 *  room for a load of LANES from any point on. */
struct Columns {
  std::vector<double> x[3], values[SETS];

  explicit Columns(std::size_t points) {
    for (auto &column : x) column.resize(points + LANES, 0.0);
    for (auto &column : values) column.resize(points + LANES, 0.0);
  }

  void set(std::size_t i, const Vector3d &at, const PointValues &from, std::size_t point) {
    for (int k = 0; k < 3; k++) x[k][i] = at[k];
    for (int n = 0; n < from.sets(); n++) values[n][i] = from.values[n][point];
  }
};

Vector3d place_of(const PointValues &points, std::size_t i) { return {points.s[0][i], points.s[1][i], points.s[2][i]}; }

/** Takes squared distances of pairs and products of their values. */
class PairTable {
 public:
  PairTable(int bins, int sets) : bins_(bins), rows_(row_of(bins + 1)), sums_(bins, sets) {}

  /** Pairs of point i with `n` points from j on. set_squared(m, r2): the squared distances of four of these, from m
   * on. */
  template <class SetSquared>
  GRAINSCOPE_INLINE void add(const Columns &points, std::size_t i, std::size_t j, int n, SetSquared set_squared) {
    double mine[SETS];
    const double *others[SETS];
    for (int k = 0; k < SETS; k++) {
      mine[k] = points.values[k][i];
      others[k] = &points.values[k][j];
    }
    double *const table = rows_.data();
    const Lanes out = Lanes{} + static_cast<double>(bins_) * bins_;
    int turn = 0;
    const auto add_four = [&](int m, const Lanes &r2) {
      const Lanes columns[LANES] = {mine[0] * load(others[0] + m), mine[1] * load(others[1] + m),
                                    mine[2] * load(others[2] + m), 1.0 + Lanes{}};
      Lanes rows[LANES];
      transpose(columns, rows);
      const Bins bin = __builtin_convertvector(root(least(r2, out)), Bins) * row_of(1);
      for (int k = 0; k < LANES; k++) {
        double *const row = table + bin[k] + LANES * k + turn;
        store(load(row) + rows[k], row);
      }
      turn ^= LANES * LANES;
    };
    int m = 0;
    Lanes r2;
    for (; m + LANES <= n; m += LANES) {
      set_squared(m, r2);
      add_four(m, r2);
    }
    if (m < n) {
      set_squared(m, r2);
      add_four(m, pick(Lanes{0, 1, 2, 3} < static_cast<double>(n - m), r2, out));
    }
    counted_ += n;
    if (counted_ > 1000 * bins_) total();  // sums of few terms are exact to more digits
  }

  PairSums sums() {
    total();
    return sums_;
  }

 private:
  int bins_, counted_ = 0;
  std::vector<double> rows_;  // of each bin `tables` rows; the last bin holds what is out of range
  PairSums sums_;

  typedef int Bins __attribute__((vector_size(4 * LANES)));
  static constexpr int row_of(int bin) { return tables * LANES * bin; }

  void total() {
    for (int k = 0; k < bins_; k++)
      for (int at = row_of(k); at < row_of(k + 1); at += LANES) {
        for (std::size_t n = 0; n < sums_.products.size(); n++) sums_.products[n][k] += rows_[at + n];
        sums_.pairs[k] += rows_[at + SETS];
      }
    std::fill(rows_.begin(), rows_.end(), 0.0);
    counted_ = 0;
  }
};
/** Equal slabs across one edge of a brick. Those at the ends of an edge that does not repeat go on for ever. */
struct Slabs {
  bool periodic = true;
  int count = 1;
  double length = 1.0, width = 1.0, per_width = 1.0, per_length = 1.0;

  void divide(int n) {
    count = n;
    width = length / n;
    per_width = n / length;
    per_length = 1.0 / length;
  }

  /** The slab of a place, the nearest one of a place that is beyond the brick. */
  GRAINSCOPE_INLINE int of(double x) const {
    const double at = x * per_width, most = count - 1, least = at > 0.0 ? at : 0.0;
    return static_cast<int>(least < most ? least : most);
  }

  GRAINSCOPE_INLINE int image_of(double x) const {
    const int many = 8;  // places here are at most two bricks away
    return periodic ? static_cast<int>(x * per_length + many) - many : 0;
  }

  GRAINSCOPE_INLINE double squared_distance(double x, int slab) const {
    const double before = slab == 0 && !periodic ? 0.0 : slab * width - x,
                 beyond = slab == count - 1 && !periodic ? 0.0 : x - (slab + 1) * width,
                 apart = std::max(before, beyond);
    return apart > 0.0 ? apart * apart : 0.0;
  }
};

/** Points of a cell, up to whose rounding radius pairs are looked for, in the brick of its lattice: a box with right
 *  angles that repeats itself as the cell does, its layers along z moved by the cell's third edge, its rows along y by
 *  the second. The points of a row stand in the order of its cells. */
class Brick {
 public:
  Brick(const Matrix3d &edges, const PeriodicCell &cell, const PointValues &given, double range)
      : edges_(edges), range_(range), points_(given.size()) {
    for (int k = 0; k < 3; k++) {
      slabs_[k].periodic = cell.periodic[k];
      slabs_[k].length = edges(k, k);
    }
    for (int k = 2; k > 0; k--)
      for (int other = k - 1; other >= 0; other--)  // another edge of the same lattice
        if (cell.periodic[other])
          edges_.col(k) -= std::round(edges_(other, k) / edges(other, other)) * edges_.col(other);
    divide(given.size());
    sort(edges, given);
  }

  /** All pairs with those points i, i % ranks = rank, that are the first of a pair. */
  GRAINSCOPE_INLINE void add(PairTable &table, int rank, int ranks) const {
    for (std::size_t i = rank; i < size_; i += ranks) {
      const double z = points_.x[2][i];
      const int layer = slabs_[2].of(z);
      for (int image = 0; image <= slabs_[2].image_of(z + range_); image++) {
        const Place at = Place{points_.x[0][i], points_.x[1][i], z}.less(image, edges_.col(2));
        const int last = slabs_[2].of(at.z + range_);
        for (int k = image == 0 ? layer : 0; k <= last; k++) add_layer(table, i, at, k, image == 0 && k == layer);
      }
    }
  }

 private:
  struct Place {
    double x, y, z;

    GRAINSCOPE_INLINE Place less(int n, const Vector3d &edge) const {
      return {x - n * edge[0], y - n * edge[1], z - n * edge[2]};
    }
  };

  Matrix3d edges_;  // tilted by half an edge at most, where they repeat
  double range_;
  Slabs slabs_[3];
  std::size_t size_ = 0;
  Columns points_;
  std::vector<std::size_t> first_;  // cell c holds the points from first_[c] to first_[c + 1]

  void divide(std::size_t points) {
    double volume = 1.0, cells;
    for (const Slabs &s : slabs_) volume *= s.length;
    double width = std::max(range_ / 4.0, std::cbrt(12.0 * volume / points));
    int n[3];
    do {
      for (int k = 0; k < 3; k++)
        n[k] = static_cast<int>(std::min(std::max(1.0, slabs_[k].length / width), static_cast<double>(points)));
      cells = static_cast<double>(n[0]) * n[1] * n[2];
      width *= 1.2;
    } while (cells > points);
    for (int k = 0; k < 3; k++) slabs_[k].divide(k == 0 ? 8 * n[k] : n[k]);
  }

  std::size_t row_of(int layer, int row) const {
    return (static_cast<std::size_t>(layer) * slabs_[1].count + row) * slabs_[0].count;
  }

  /** Wrapped into the brick. */
  Vector3d place(const Matrix3d &edges, Vector3d s) const {
    for (int k = 0; k < 3; k++)
      if (slabs_[k].periodic) s[k] -= std::floor(s[k]);
    Vector3d at = edges * s;
    for (int k = 2; k >= 0; k--)
      if (slabs_[k].periodic) at -= std::floor(at[k] * slabs_[k].per_length) * edges_.col(k);
    return at;
  }

  /** Not so where it is not finite, or so far out that wrapping has no digits left. */
  bool is_place(const Vector3d &at) const {
    bool is = true;
    for (int k = 0; k < 3; k++)
      is = is && (slabs_[k].periodic ? std::fabs(at[k]) < 2.0 * slabs_[k].length : std::isfinite(at[k]));
    return is;
  }

  void sort(const Matrix3d &edges, const PointValues &given) {
    const std::size_t nowhere = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> cells(given.size(), nowhere);
    first_.assign(row_of(slabs_[2].count, 0) + 1, 0);
    for (std::size_t i = 0; i < given.size(); i++) {
      const Vector3d at = place(edges, place_of(given, i));
      if (!is_place(at)) continue;
      cells[i] = row_of(slabs_[2].of(at[2]), slabs_[1].of(at[1])) + slabs_[0].of(at[0]);
      first_[cells[i] + 1]++;
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    size_ = first_.back();
    std::vector<std::size_t> next(first_);
    for (std::size_t i = 0; i < given.size(); i++)
      if (cells[i] != nowhere) points_.set(next[cells[i]]++, place(edges, place_of(given, i)), given, i);
  }

  /** Partners in a layer; in that of point i itself only those after it. */
  GRAINSCOPE_INLINE void add_layer(PairTable &table, std::size_t i, const Place &place, int layer, bool own) const {
    const Slabs &rows = slabs_[1];
    const double left = range_ * range_ - slabs_[2].squared_distance(place.z, layer);
    if (!(left > 0.0)) return;
    const double reach = std::sqrt(left);
    const int last_image = rows.image_of(place.y + reach), own_row = rows.of(place.y);
    for (int image = own ? 0 : rows.image_of(place.y - reach); image <= last_image; image++) {
      const Place at = place.less(image, edges_.col(1));
      const bool from_own = own && image == 0;
      const int last = rows.of(at.y + reach);
      for (int row = from_own ? own_row : rows.of(at.y - reach); row <= last; row++)
        add_row(table, i, at, row_of(layer, row), left - rows.squared_distance(at.y, row), from_own && row == own_row);
    }
  }

  GRAINSCOPE_INLINE void add_row(PairTable &table, std::size_t i, const Place &place, std::size_t row, double left,
                                 bool own) const {
    const Slabs &cells = slabs_[0];
    if (!(left > 0.0)) return;
    const double reach = std::sqrt(left);
    const int last_image = cells.image_of(place.x + reach);
    for (int image = own ? 0 : cells.image_of(place.x - reach); image <= last_image; image++) {
      const double x = place.x - image * cells.length;
      const std::size_t begin = own && image == 0 ? i + 1 : first_[row + cells.of(x - reach)],
                        end = first_[row + cells.of(x + reach) + 1];
      if (begin < end) add_some(table, i, {x, place.y, place.z}, begin, static_cast<int>(end - begin));
    }
  }

  GRAINSCOPE_INLINE void add_some(PairTable &table, std::size_t i, const Place &at, std::size_t j, int n) const {
    const double *const x = &points_.x[0][j], *const y = &points_.x[1][j], *const z = &points_.x[2][j];
    table.add(points_, i, j, n, [&](int m, Lanes &r2) {
      const Lanes a = load(x + m) - at.x, b = load(y + m) - at.y, c = load(z + m) - at.z;
      r2 = a * a + b * b + c * c;
    });
  }
};

/** Points of any cell at any range, in the order of their places along its longest height: partners are within range
 *  along that, and at the nearest of all images. */
class Queue {
 public:
  Queue(const PeriodicCell &cell, const PointValues &given, double range)
      : cell_(cell), images_(cell, range), points_(given.size()) {
    for (int k = 0; k < 3; k++)
      if (cell.height(k) > cell.height(along_)) along_ = k;
    reach_ = slack * range / cell.height(along_);
    std::vector<std::size_t> order;
    std::vector<double> s(given.s[along_]);
    for (std::size_t i = 0; i < given.size(); i++) {
      if (cell.periodic[along_]) s[i] -= std::floor(s[i]);
      if (place_of(given, i).allFinite()) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return s[i] < s[j]; });
    for (std::size_t i : order) {
      Vector3d at = place_of(given, i);
      at[along_] = s[i];
      points_.set(size_++, at, given, i);
    }
  }

  GRAINSCOPE_INLINE void add(PairTable &table, int rank, int ranks) {
    const bool all = !(reach_ < 0.5), periodic = cell_.periodic[along_];
    for (std::size_t i = rank; i < size_; i += ranks) {
      const double end = points_.x[along_][i] + reach_;
      add_span(table, i, i + 1, all ? size_ : first_after(end));
      if (periodic && !all) add_span(table, i, 0, first_after(end - 1.0));
    }
  }

 private:
  PeriodicCell cell_;
  NearestImages images_;
  int along_ = 0;
  double reach_;
  std::size_t size_ = 0;
  Columns points_;
  double x_[batch], y_[batch], z_[batch], squared_[batch];

  std::size_t first_after(double s) const {
    const auto begin = points_.x[along_].begin();
    return std::upper_bound(begin, begin + size_, s) - begin;
  }

  GRAINSCOPE_INLINE void add_span(PairTable &table, std::size_t i, std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; j += batch) {
      const int n = static_cast<int>(std::min<std::size_t>(batch, end - j));
      set_squared(i, j, n);
      images_.lower(n, x_, y_, z_, squared_);
      table.add(points_, i, j, n, [&](int m, Lanes &r2) { r2 = load(squared_ + m); });
    }
  }

  GRAINSCOPE_INLINE void set_squared(std::size_t i, std::size_t j, int n) {
    const double *sx = &points_.x[0][j], *sy = &points_.x[1][j], *sz = &points_.x[2][j];
    const double x = points_.x[0][i], y = points_.x[1][i], z = points_.x[2][i];
    const Matrix3d &h = cell_.edges;
    const double xx = h(0, 0), xy = h(0, 1), xz = h(0, 2), yy = h(1, 1), yz = h(1, 2), zz = h(2, 2);
    const double wx = cell_.periodic[0], wy = cell_.periodic[1], wz = cell_.periodic[2];
    const double rounder = 6755399441055744.0;  // 1.5 2^52: adding and taking it off rounds to the nearest whole number
    for (int m = 0; m < n; m++) {
      double a = sx[m] - x, b = sy[m] - y, c = sz[m] - z;
      a -= wx * ((a + rounder) - rounder);
      b -= wy * ((b + rounder) - rounder);
      c -= wz * ((c + rounder) - rounder);
      x_[m] = xx * a + xy * b + xz * c;
      y_[m] = yy * b + yz * c;
      z_[m] = zz * c;
      squared_[m] = x_[m] * x_[m] + y_[m] * y_[m] + z_[m] * z_[m];
    }
  }
};

GRAINSCOPE_CLONES void add_pairs(const Brick &points, PairTable &table, int rank, int ranks) {
  points.add(table, rank, ranks);
}

GRAINSCOPE_CLONES void add_pairs(Queue &points, PairTable &table, int rank, int ranks) {
  points.add(table, rank, ranks);
}

}

void PointValues::add(const Vector3d &fraction, const double *value) {
  for (int k = 0; k < 3; k++) s[k].push_back(fraction[k]);
  for (int n = 0; n < sets(); n++) values[n].push_back(value[n]);
}

PairSums direct_pair_sums(const PeriodicCell &cell, const PointValues &points, const DistanceBins &bins, int rank,
                          int ranks) {
  if (points.size() < 2) return PairSums(bins.count, points.sets());
  const PeriodicCell scaled{cell.edges * (outward * bins.count / bins.range), cell.periodic};
  PairTable table(bins.count, points.sets());
  if (bins.range <= cell.rounding_radius() && scaled.edges.allFinite()) {
    add_pairs(Brick(scaled.edges, scaled, points, slack * bins.count), table, rank, ranks);
  } else {
    Queue queue(scaled, points, bins.count);
    add_pairs(queue, table, rank, ranks);
  }
  return table.sums();
}

}

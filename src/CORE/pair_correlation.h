// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PAIR_CORRELATION_H
#define GRAINSCOPE_PAIR_CORRELATION_H

#include "periodic_cell.h"
#include <vector>

namespace grainscope {

/** Equal bins of the distance r over [0, range). */
struct DistanceBins {
  double range;
  int count;

  double width() const { return range / count; }
  double middle(int k) const { return (k + 0.5) * width(); }
};

/** Per bin, the number of pairs, each pair once, and the sums over them of the products of their values: of each set of
 *  values [set][bin]. */
struct PairSums {
  explicit PairSums(int bins, int sets = 1) : products(sets, std::vector<double>(bins, 0.0)), pairs(bins, 0.0) {}
  std::vector<std::vector<double>> products;
  std::vector<double> pairs;
};

/** Positions in units of the box edges, and of each point one value of each set, [set][point]. */
struct PointValues {
  static constexpr int MOST_SETS = 3;

  explicit PointValues(int sets = 1) : values(sets) {}
  std::vector<double> s[3];
  std::vector<std::vector<double>> values;

  int sets() const { return values.size(); }
  std::size_t size() const { return s[0].size(); }
  /** Takes sets() numbers. */
  void add(const Eigen::Vector3d &fraction, const double *value);
  void add(const Eigen::Vector3d &fraction, double value) { add(fraction, &value); }
};

/** The sums over all pairs of points at their nearest images; the share of them that falls to `rank` of `ranks`, all of
 *  which hold the same points; those whose place is not finite are left out. The work grows with the square of their
 *  number; less when `range` is short against the box; hardly with the sets of values, of which there are at most
 *  MOST_SETS. */
PairSums direct_pair_sums(const PeriodicCell &cell, const PointValues &points, const DistanceBins &bins, int rank = 0,
                          int ranks = 1);

}

#endif

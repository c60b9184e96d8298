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

/** Per bin, the sum over pairs of the product of their values, and the number of pairs, each pair once. */
struct PairSums {
  explicit PairSums(int bins) : products(bins, 0.0), pairs(bins, 0.0) {}
  std::vector<double> products, pairs;
};

/** Positions in units of the box edges, and one value each. */
struct PointValues {
  std::vector<double> s[3], value;

  std::size_t size() const { return value.size(); }
  void add(const Eigen::Vector3d &fraction, double v);
};

/** The sums over all pairs of points at their nearest images; the share of them that falls to `rank` of `ranks`, all of
 *  which hold the same points; those whose place is not finite are left out. The work grows with the square of their
 *  number; less when `range` is short against the box. */
PairSums direct_pair_sums(const PeriodicCell &cell, const PointValues &points, const DistanceBins &bins, int rank = 0,
                          int ranks = 1);

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_LAG_MESH_H
#define GRAINSCOPE_LAG_MESH_H

#include "pair_correlation.h"
#include <array>
#include <cstddef>

namespace grainscope {

/** The smallest product of 2, 3, 5 and 7 from `at_least` on: Fourier transforms of such lengths are fast. */
int fast_length(int at_least);

/** Numbers of cells along the edges: at least `per_bin` to the width of a bin, rounded up to fast lengths; one
 *  along an edge that is not periodic, which is across the plane of two dimensions. Throws std::length_error when there
 *  would be more than `most` in all. */
std::array<int, 3> mesh_size(const PeriodicCell &cell, const DistanceBins &bins, int per_bin, double most);

/** A mesh of equal cells along the edges of a box that is periodic in all that are divided, and the slab of it that one
 *  rank holds: whole planes across the first edge, in rows along the last that are padded to `row` numbers. */
struct LagMesh {
  std::array<int, 3> size;
  std::ptrdiff_t first_plane, planes, row;

  /** -1 along an edge where the place is not finite. */
  std::array<int, 3> cell_of(const PointValues &points, std::size_t i) const;
  /** Where a cell stands within its plane. */
  std::ptrdiff_t in_plane(const std::array<int, 3> &cell) const { return cell[1] * row + cell[2]; }
};

/** Adds a correlation, known at each lag of the slab, to the bins of the lags' lengths, that of the nearest image for
 *  each. With `whole` each value is rounded to a whole number first. */
void add_lags(const PeriodicCell &cell, const LagMesh &mesh, const double *correlation, bool whole,
              const DistanceBins &bins, std::vector<double> &sums);

}

#endif

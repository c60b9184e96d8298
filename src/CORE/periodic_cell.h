// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PERIODIC_CELL_H
#define GRAINSCOPE_PERIODIC_CELL_H

#include "bin_index.h"
#include <Eigen/Core>
#include <array>
#include <vector>

namespace grainscope {

/** A sheared box, its edge vectors in the columns of an upper triangular matrix, and the edges along which it repeats
 *  itself. */
struct PeriodicCell {
  Eigen::Matrix3d edges = Eigen::Matrix3d::Identity();
  std::array<bool, 3> periodic{{true, true, true}};

  /** Distance between the two faces that cut edge k. */
  double height(int k) const;
  /** Half the smallest height across periodic edges, infinite without any. The one image of a separation that is
   *  shorter than this, if there is one, is that whose components along the edges are rounded into [-1/2, 1/2]. */
  double rounding_radius() const;
};

/** The cell, of n along an edge, of a place in units of the edge; what lies beyond the edge in the one at its end, -1
 *  for what is not finite. */
inline int cell_along(double s, int n) { return nearest_bin_index(s * n, n); }

/** Nearest images at any distance up to a range: those with rounded components, moved by the few lattice vectors that
 *  bring one of them nearer. There are none up to the rounding radius, nor in a box with right angles. */
class NearestImages {
 public:
  NearestImages(const PeriodicCell &cell, double range);

  /** Lowers the squared lengths r2 of n rounded separations (x, y, z) to those of their nearest images. */
  void lower(int n, const double *x, const double *y, const double *z, double *r2) const;

 private:
  std::vector<Eigen::Vector3d> shifts_;
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PERIODIC_CELL_H
#define GRAINSCOPE_PERIODIC_CELL_H

#include <Eigen/Core>
#include <array>

namespace grainscope {

/** A sheared box, its edge vectors in the columns of an upper triangular matrix, and the edges along which it repeats itself.
 *  Separations are given in units of the edges. */
struct PeriodicCell {
  Eigen::Matrix3d edges = Eigen::Matrix3d::Identity();
  std::array<bool, 3> periodic{{true, true, true}};

  /** Distance between the two faces that cut edge k. */
  double height(int k) const;
  /** Half the smallest height across periodic edges, infinite without any. The one image nearer than this, if there is one, is that
   *  with each component rounded into [-1/2, 1/2]. */
  double rounding_radius() const;
  /** Square of the distance to the nearest image, at any distance. */
  double nearest_squared(Eigen::Vector3d separation) const;
};

}

#endif

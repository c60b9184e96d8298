// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FIELD_GRADIENT_H
#define GRAINSCOPE_FIELD_GRADIENT_H

#include "field_map.h"
#include "field_sums.h"
#include <vector>

namespace grainscope {

/** The mean motion about each cell of a field, v(x) = v_k + G_k (x - c_k): v_k the mean velocity of the cell by mass,
 *  c_k the centre of its mass, and G_k the gradient that fits v of the cell and its neighbours along each axis that is
 *  divided, least squares by mass. So an affine flow has no motion against it. */
class FieldMotion {
 public:
  /** `wraps`: axes along which the last cell is a neighbour of the first; `jumps`: in columns, by how much what lies
   *  beyond the last cell along that axis is faster. The sums have mass, momentum and centroid. */
  FieldMotion(const FieldMap &map, const FieldSums &sums, const std::array<bool, 3> &wraps,
              const Eigen::Matrix3d &jumps);

  /** At a place near the cell, by components of its frame (FieldCells::position). */
  Eigen::Vector3d velocity(int cell, const Eigen::Vector3d &position) const {
    const Mean &mean = means_[cell];
    return mean.velocity + mean.gradient * (position - mean.centre);
  }

 private:
  struct Mean {
    double mass = 0.0;
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), centre = Eigen::Vector3d::Zero();
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  };
  std::vector<Mean> means_;

  Eigen::Matrix3d fitted(const FieldMap &map, int cell, const std::array<bool, 3> &wraps,
                         const Eigen::Matrix3d &jumps) const;
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_BOX_JUMP_H
#define GRAINSCOPE_BOX_JUMP_H

#include "box_state.h"
#include <Eigen/LU>
#include <cmath>

namespace grainscope {

/** The change of the velocities of the box's edges between two steps. A grain beyond a face that was wrapped before it
 *  has the velocity of its place in the box; one that is still to be wrapped takes on the new velocity of the face, and
 *  its contacts would never see the change. Given the change by place, n edges times the change of their velocities,
 *  where n is how many edges it lies outside, both are the same grain. */
class BoxJump {
 public:
  /** `before`: the box of the step that ends, and the velocities of its edges in it. */
  BoxJump(const BoxState &before, const Eigen::Matrix3d &edge_velocities_after)
      : change_(edge_velocities_after - before.edge_velocities), inverse_(before.edges.inverse()),
        centre_(before.cell_centre), periodic_(before.periodic) {}

  bool none() const { return change_.isZero(0.0); }

  /** Of a grain at x; false inside the box. */
  bool gives(const Eigen::Vector3d &x, Eigen::Vector3d &velocity) const {
    const double dx = x[0] - centre_[0], dy = x[1] - centre_[1], dz = x[2] - centre_[2];
    const double away[3] = {inverse_(0, 0) * dx + inverse_(0, 1) * dy + inverse_(0, 2) * dz,
                            inverse_(1, 1) * dy + inverse_(1, 2) * dz, inverse_(2, 2) * dz};
    if (std::fabs(away[0]) <= 0.5 && std::fabs(away[1]) <= 0.5 && std::fabs(away[2]) <= 0.5) return false;
    Eigen::Vector3d edges = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; k++)
      if (periodic_[k]) edges[k] = std::floor(away[k] + 0.5);
    velocity = change_ * edges;
    return true;
  }

 private:
  Eigen::Matrix3d change_, inverse_;
  Eigen::Vector3d centre_;
  std::array<bool, 3> periodic_;
};

}

#endif

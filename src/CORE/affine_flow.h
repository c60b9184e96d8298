// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_AFFINE_FLOW_H
#define GRAINSCOPE_AFFINE_FLOW_H

#include <Eigen/Core>

namespace grainscope {

/** The mean flow of a deforming box, L (x - x_c). Its velocity gradient L is upper triangular, as the matrix of the
 *  edges is. */
struct AffineFlow {
  Eigen::Matrix3d velocity_gradient = Eigen::Matrix3d::Zero();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();

  /** L r. */
  Eigen::Vector3d gradient_times(const Eigen::Vector3d &r) const {
    const Eigen::Matrix3d &l = velocity_gradient;
    return {l(0, 0) * r[0] + l(0, 1) * r[1] + l(0, 2) * r[2], l(1, 1) * r[1] + l(1, 2) * r[2], l(2, 2) * r[2]};
  }
  /** Velocity at x; zero at the centre. */
  Eigen::Vector3d flow(const Eigen::Vector3d &x) const { return gradient_times(x - centre); }
  /** The same velocity everywhere? */
  bool operator==(const AffineFlow &o) const {
    return velocity_gradient == o.velocity_gradient && velocity_gradient * centre == velocity_gradient * o.centre;
  }
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_BOX_JUMP_H
#define GRAINSCOPE_BOX_JUMP_H

#include "box_state.h"
#include "outside_cell.h"
#include <Eigen/LU>
#include <cmath>

namespace grainscope {

/** The change of the velocities of the box's edges between two steps. A grain beyond a face that was wrapped before the
 *  change has the velocity of its place in the box. A grain that is still to be wrapped takes on the new velocity of
 *  the face, and its contacts would never see the change. If the change is added by place (n edges times the change of
 *  their velocities, where n is how many edges it lies outside), both are the same grain. */
class BoxJump {
 public:
  /** `before`: the box of the step that ends, and the velocities of its edges in it. */
  BoxJump(const BoxState &before, const Eigen::Matrix3d &edge_velocities_after)
      : change_(edge_velocities_after - before.edge_velocities), periodic_(before.periodic) {
    const Eigen::Matrix3d inverse = before.edges.inverse();
    for (int k = 0; k < 3; k++) {
      cell_.centre[k] = before.cell_centre[k];
      for (int l = 0; l < 3; l++) cell_.inverse[k][l] = inverse(k, l);
    }
  }

  bool none() const { return change_.isZero(0.0); }

  /** Of a grain at x; false inside the box. */
  bool gives(const Eigen::Vector3d &x, Eigen::Vector3d &velocity) const {
    double away[3];
    cell_.place(x.data(), away);
    if (std::fabs(away[0]) <= 0.5 && std::fabs(away[1]) <= 0.5 && std::fabs(away[2]) <= 0.5) return false;
    Eigen::Vector3d edges = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; k++)
      if (periodic_[k]) edges[k] = std::floor(away[k] + 0.5);
    velocity = change_ * edges;
    return true;
  }

  /** Adds it to the velocities of `n` grains, rows of three numbers. */
  void give(const double *x, double *v, int n) const {
    Eigen::Vector3d velocity;
    for (int i = next_outside(cell_, x, 0, n); i < n; i = next_outside(cell_, x, i + 1, n))
      if (gives(Eigen::Map<const Eigen::Vector3d>(x + 3 * i), velocity))
        Eigen::Map<Eigen::Vector3d>(v + 3 * i) += velocity;
  }

 private:
  Eigen::Matrix3d change_;
  CellFrame cell_;
  std::array<bool, 3> periodic_;
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_BOX_STATE_H
#define GRAINSCOPE_BOX_STATE_H

#include "affine_flow.h"
#include <array>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace grainscope {

/** Box edges in columns from the host's h or h_rate: xx yy zz yz xz xy. */
Eigen::Matrix3d upper_triangular(const double *h);

/** The simulation box at one moment, and the affine flow of its grains about the middle of its edges, which neither
 *  tilts nor box flips move. H holds the edge vectors in its columns, dH/dt their velocities. The velocity gradient is
 *  dH/dt H^-1 and includes the motion of an edge that is being moved. Zero for a box that does not deform, or deforms
 *  without `remap v`. With `dimension 2` the third edge is one unit of length across the plane of the grains, whatever
 *  the depth of the box, and is not periodic. */
struct BoxState : AffineFlow {
  Eigen::Matrix3d edges = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d edge_velocities = Eigen::Matrix3d::Zero();
  int dimension = 3;
  double volume = 1.0;                                    // Omega; with `dimension 2` the area L_x L_y
  Eigen::Vector3d cell_centre = Eigen::Vector3d::Zero();  // of the tilted box
  std::array<bool, 3> periodic{{true, true, true}};

  BoxState() = default;
  explicit BoxState(LAMMPS_NS::LAMMPS *lmp);

  /** Distance between the two faces that cut edge k, k = 0, 1, 2. */
  double height(int k) const;
  /** x in units of the box edges, 0 to 1 inside. */
  Eigen::Vector3d fraction(const Eigen::Vector3d &x) const;
  /** Which of `layers` layers of equal height across edge k holds x, 0 to layers - 1. Periodic where the box is;
   *  elsewhere what is beyond a face, as a grain may be until a face that follows the grains is moved, belongs to the
   *  layer there. -1 for a place that is not finite. */
  int layer(const Eigen::Vector3d &x, int k, int layers) const;
};

}

#endif

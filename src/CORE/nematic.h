// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_NEMATIC_H
#define GRAINSCOPE_NEMATIC_H

#include "symmetry_axis.h"
#include <Eigen/Core>
#include <array>

namespace grainscope {

/** Sums over grains for the nematic order; plain doubles, so that ranks add them up. */
struct NematicSums {
  // p p (xx yy zz xy xz yz), grains with an axis, cos 2theta, sin 2theta, grains with a theta, oblate grains, omega
  // (3), grains
  std::array<double, 15> sums{};

  /** `flow`, `gradient`: the axes of the plane that theta is in; measured from the first towards the second. */
  explicit NematicSums(int flow = 0, int gradient = 1) : flow_(flow), gradient_(gradient) {}

  /** Grains that have one axis, or none, with index < 0; their quaternions and angular velocities one after the
   *  other. */
  void add_alike(int count, const SymmetryAxis &axis, const double *quaternion, const double *omega);
  /** How many of `count` grains, from the first on, have its semi-axes. */
  static int alike(int count, const double *semi_axes);
  /** Grains whose axis is their shortest. */
  double oblate() const { return sums[10]; }
  Eigen::Vector3d in_plane(const Eigen::Vector3d &v) const {
    return {v[flow_], v[gradient_], v[3 - flow_ - gradient_]};
  }

 private:
  int flow_, gradient_;
};

/** Angle of the line along (x, y) with the x axis, in (-pi/2, pi/2]. */
double line_angle(double x, double y);

/** Angle of a grain's major axis with x in the xy plane, from its symmetry axis: the axis itself for prolate and
 *  triaxial grains, at right angles to it for oblate ones, in (-pi/2, pi/2]; 0 where the axis stands on the plane
 *  (|p_xy| < 1e-9). */
double major_axis_angle(const Eigen::Vector3d &axis, Shape shape);

/** Nematic order of the grains' symmetry axes p_i, Bilotto et al. 2025, Eq. (3) and Fig. 2. */
struct Nematic {
  explicit Nematic(const NematicSums &sums);

  Eigen::Matrix3d q;            // <p p> - 1/3; zero without grains
  Eigen::Vector3d eigenvalues;  // of q, descending
  Eigen::Vector3d director;     // eigenvector of the largest, its largest component positive; zero without grains
  double order;                 // S2 = 3/2 largest eigenvalue
  double biaxiality;            // middle less smallest eigenvalue
  double theta;                 // mean angle of the major axis with the flow in the plane, (-pi/2, pi/2]
  double director_theta;        // the same angle of the director
  Eigen::Vector3d spin;         // mean angular velocity
  double grains_with_axis, grains_with_theta;
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ELLIPSOID_BANDS_H
#define GRAINSCOPE_ELLIPSOID_BANDS_H

#include <Eigen/Core>
#include <vector>

namespace grainscope {

/** How the angle psi locates a point on an ellipsoid: measured from one of its axes, 0 at the pole and pi/2 at the
 *  equator. */
enum class SurfaceAngle {
  polar,      // between the axis and the point as seen from the centre
  parametric  // tan psi = sqrt((x/a)^2 + (y/b)^2) / |z/c|, c along the axis
};

/** psi of the point `x`, relative to the centre and in the frame of the grain: x[2] along the axis, `semi_axes`
 *  likewise. */
double surface_angle(const Eigen::Vector3d &x, const Eigen::Vector3d &semi_axes, SurfaceAngle angle);

/** Band of psi in [0, pi/2], of `bands` equal ones; pi/2 belongs to the last; -1 for NaN. */
int band_of(double psi, int bands);

/** Areas of the bands of an ellipsoid, those north and south together, [distance^2]. Their sum is the ellipsoid's area;
 *  relative error 1e-13 (2e-12 where semi-axes are as 500 to 1), by adaptive Gauss-Kronrod quadrature of the exact area
 *  element. */
std::vector<double> band_areas(const Eigen::Vector3d &semi_axes, int bands, SurfaceAngle angle);

}

#endif

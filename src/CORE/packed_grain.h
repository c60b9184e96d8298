// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PACKED_GRAIN_H
#define GRAINSCOPE_PACKED_GRAIN_H

namespace grainscope {

/** What a contact asks of a grain, in rows of four numbers. */
struct alignas(64) PackedGrain {
  double x[3], reach;  // centre, and radius of the bounding sphere
  double velocity[3], mass;
  double spin[3], size;  // angular velocity, and radius of the sphere of equal volume
  // of a spheroid, as in Spheroid; axis[0] of a grain among nothing but spheres: the radius that contacts are found by;
  // of a triaxial grain, of which no contact asks for them, the quaternion
  double axis[3], inverse_product;
};

/** As in Spheroid. */
struct alignas(32) PackedShape {
  double equatorial_square, polar_square, inverse_equatorial_square, inverse_polar_square;
};

/** The fourth number of each row is read by nobody. */
struct alignas(64) PackedForce {
  double force[4], torque[4];
};

/** Grains as others keep them: rows of three numbers and quaternions, one after the other. */
struct GrainRows {
  int count;
  const double *x, *velocity, *spin, *quaternion, *radius, *mass;
  const double *size;  // null where that of PackedGrain stays
};

/** Places and motions into `grains`. */
void pack_motion(const GrainRows &rows, PackedGrain *grains);
/** And axes, of spheroids: symmetry[i] is the body axis of grain i that is its own, 0, 1 or 2; KEPT leaves it as it is,
 *  of spheres; QUATERNION is for triaxial grains. */
constexpr unsigned char KEPT = 3, QUATERNION = 4;
void pack_axes(const GrainRows &rows, const unsigned char *symmetry, PackedGrain *grains);

}

#endif

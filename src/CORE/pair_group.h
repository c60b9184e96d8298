// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PAIR_GROUP_H
#define GRAINSCOPE_PAIR_GROUP_H

#include "pair_law.h"

namespace grainscope {

/** What a contact asks of a grain, in rows of four numbers; spheroids have their axes in the last. */
struct alignas(64) PackedGrain {
  double x[3], reach;  // centre, and radius of the bounding sphere
  double velocity[3], mass;
  double spin[3], size;             // angular velocity, and radius of the sphere of equal volume
  double axis[3], inverse_product;  // as in Spheroid
};
struct alignas(32) PackedShape {  // as in Spheroid
  double equatorial_square, polar_square, inverse_equatorial_square, inverse_polar_square;
};
/** The fourth number of each row is read by nobody. */
struct alignas(64) PackedForce {
  double force[4], torque[4];
};

/** Pairs of grains that are worked on together. The arrays are full: idle places repeat the last pair. */
struct PairGroup {
  int size;
  int i[LANES], j[LANES];
  // of each pair in the contact history: lambda - 1/2, or 0; behind it, with Tangential::history, the spring
  double *history[LANES];
};

/** How the pairs of a group lie to each other, as in EllipsoidContact. */
struct GroupGeometry {
  Lanes d[3], square;  // x_j - x_i
  Lanes normal[3], point[3], depth[2], curvature[2], lambda, gap, steps;
  LaneMask reachable;  // bounding spheres overlap; the others are apart by `gap`
  LaneMask touching;
  LaneMask alone;  // to be asked of ellipsoid_contact(): concentric, not settled, or no numbers
};

/** What the law made of the contacts of a group, for those that measure. */
struct GroupForces {
  Lanes normal[3], force[3];  // towards i, on i
  Lanes overlap, normal_velocity, tangential_velocity[3], point[3];
  Lanes law_force, kn, kt, gamma_n, gamma_t, friction, limit;
  Lanes before[3], uncut[3], after[3], length;  // of the spring (Friction), or of the tangential velocity
  LaneMask cut;
};

struct PackedGrains {
  const PackedGrain *grains;
  const PackedShape *shapes;  // of each grain
  PackedForce *forces;        // of the `own` first grains, and of one more, which takes what is for ghosts
  int own;
};

/** ellipsoid_contact() of spheroids that are not both spheres. */
void meet_spheroids(const PackedGrains &grains, const PairGroup &group, GroupGeometry &geometry);
/** sphere_contact(), of grains that have the radius of the contact in axis[0]. */
void meet_round(const PackedGrains &grains, const PairGroup &group, GroupGeometry &geometry);
/** Spheres that touch where their bounding spheres do: fills in d, square, reachable, touching and gap. */
void meet_spheres(const PackedGrains &grains, const PairGroup &group, GroupGeometry &geometry);

struct GroupLaw {
  const PairLaw &law;
  const PairLaw::Terms *terms[LANES];  // of each pair; only the first is read if there is but one atom type
  bool frozen;                         // some grains are: a pair's mass is then that of the other
  LaneMask frozen_i, frozen_j;
};

/** Adds the forces of the contacts that touch, pair after pair, and moves their springs. `kept`, if not null, tells
 *  what was made of them. */
void push_ellipsoids(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &geometry,
                     const GroupLaw &law, GroupForces *kept);
/** The same of spheres after meet_round(). */
void push_round(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &geometry, const GroupLaw &law,
                GroupForces *kept);
/** The same of spheres after meet_spheres(), by the formulas of LIGGGHTS's `surface default`. */
void push_spheres(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &geometry,
                  const GroupLaw &law, GroupForces *kept);

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PAIR_GROUP_H
#define GRAINSCOPE_PAIR_GROUP_H

#include "packed_grain.h"
#include "pair_law.h"
#include <cstdint>

namespace grainscope {

/** `size` pairs of grains that are worked on together. The arrays are full: idle places repeat the last pair, and what
 *  is found of them is false. */
struct PairGroup {
  int size;
  int i[LANES], j[LANES];
  // of each pair in the contact history: lambda - 1/2, or 0, of ellipsoids; then, with Tangential::history, the spring
  double *history[LANES];
};

/** How the pairs of a group lie to each other, as in EllipsoidContact. */
struct GroupGeometry {
  Lanes d[3], square;  // x_j - x_i
  Lanes normal[3], point[3], depth[2], curvature[2], lambda, gap, steps;
  LaneMask reachable;  // bounding spheres overlap; the others are apart by `gap`
  LaneMask touching;
  LaneMask apart;  // not touching, of pairs that are there
  LaneMask met;    // touching, and did not when they were looked at last, as far as the history tells
  LaneMask alone;  // to be asked of ellipsoid_contact(): concentric, not settled, or no numbers
};

/** What the law made of the contacts of a group, for those that measure; 0 in lanes that do not touch. */
struct GroupForces {
  Lanes weight;               // 1, or 1/2 where j is a ghost
  Lanes normal[3], force[3];  // towards i, on i
  Lanes overlap, law_force, kn, kt, gamma_n, gamma_t, friction, limit;
  Lanes length;  // of the uncut spring (Friction), or of the tangential velocity
  LaneMask cut;
  // How they move; left out where nobody asks for it.
  bool motion = true;
  Lanes normal_velocity, tangential_velocity[3];
  Lanes arm[3];  // from the centre of i to the contact point
  // The contact point, for Contacts; the spring (Friction), for the ledger.
  bool points = true, springs = true;
  Lanes point[3], before[3], uncut[3], after[3];
  // With `time_level synchronized`, for the ledger (Contact::at_force).
  bool synchronized = false;
  Lanes normal_at_force, tangential_at_force[3];

  /** The velocity that forces work with. */
  const Lanes &working_normal() const { return synchronized ? normal_at_force : normal_velocity; }
  const Lanes *working_tangential() const { return synchronized ? tangential_at_force : tangential_velocity; }
};

struct PackedGrains {
  const PackedGrain *grains;
  const PackedShape *shapes;  // of each grain, or
  bool one_shape;             // the first is that of all
  PackedForce *forces;        // of the `own` first grains, and of one more, which takes what is for ghosts
  int own;
};

/** What the solver did, lane by lane: pairs in each, those that touch, steps, and the most steps of one pair. */
struct SolverTally {
  LaneMask solved{}, touching{};  // as negative numbers
  Lanes steps{}, most_steps{};
};

/** ellipsoid_contact() of spheroids that are not both spheres; those that are `alone` are not counted. */
void meet_spheroids(const PackedGrains &grains, const PairGroup &group, GroupGeometry &geometry, SolverTally &tally);
/** Which of the pairs of meet_spheroids() are surely `apart`, found without a start and with a margin against rounding;
 *  of others nothing is known. Fills in `gap` and `reachable` beside. */
void part_spheroids(const PackedGrains &grains, const PairGroup &group, GroupGeometry &geometry);
/** Which of at most 64 grains have a bounding sphere that overlaps that of grain i: a bit for each. The number of a
 *  grain is others[k] & mask. */
std::uint64_t within_reach(const PackedGrain *grains, int i, const int *others, int mask, int count);
/** sphere_contact(), of grains that have the radius of the contact in axis[0]. */
void meet_round(const PackedGrains &grains, const PairGroup &group, GroupGeometry &geometry, SolverTally &tally);
/** Spheres that touch where their bounding spheres do: fills in d, square, reachable, touching and gap. */
void meet_spheres(const PackedGrains &grains, const PairGroup &group, GroupGeometry &geometry);

struct GroupLaw {
  const PairLaw *law;
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
/** The same with `time_level synchronized`: functions of their own, or the usual way would pay for their registers. */
void push_ellipsoids_synchronized(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &geometry,
                                  const GroupLaw &law, GroupForces *kept);
void push_round_synchronized(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &geometry,
                             const GroupLaw &law, GroupForces *kept);
void push_spheres_synchronized(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &geometry,
                               const GroupLaw &law, GroupForces *kept);

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_HALF_STEP_H
#define GRAINSCOPE_HALF_STEP_H

#include "lanes.h"

/** `time_level synchronized`. Velocity Verlet forms forces at x_n with the velocities of the middle of the step before.
 *  With normal and arms of x_n two surfaces that roll on each other then seem to slip: here normal and arms are those of
 *  the middle, too. The velocity of the surfaces against each other is turned from the normal of the middle to that of
 *  x_n, where the force acts, and the tangential spring from the normal of the step before: each by the shortest
 *  rotation, which keeps its length. */
namespace grainscope { namespace half_step {

template <class Real>
GRAINSCOPE_INLINE Real inner(const Real *a, const Real *b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class Real>
GRAINSCOPE_INLINE void outer(const Real *a, const Real *b, Real *c) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

/** How two grains move, or a grain and a wall, whose spin is 0. */
template <class Real>
struct Motion {
  Real velocity[3];  // of the centre of i against that of j, or against the wall
  Real spin_i[3], spin_j[3];
};

/** A contact at one moment, from i's side. */
template <class Real>
struct Moment {
  Real normal[3];           // towards i
  Real arm_i[3], arm_j[3];  // from the centres to the contact point; at a wall that of i alone has a meaning
};

/** The middle of a step of two spheres, whose centres have moved by their velocities. `normal`, `branch` = x_i - x_j:
 *  at its end. */
template <class Real>
GRAINSCOPE_INLINE void middle_of_spheres(const Real *normal, const Real *branch, Real radius_i, Real radius_j,
                                         const Motion<Real> &motion, double dt, Moment<Real> &middle) {
  Real half[3];
  for (int k = 0; k < 3; k++) half[k] = branch[k] - (0.5 * dt) * motion.velocity[k];
  const Real distance = root(inner(half, half)), overlap = radius_i + radius_j - distance;
  const Real lever_i = radius_i - 0.5 * overlap, lever_j = radius_j - 0.5 * overlap;
  const auto goes_on = inner(half, normal) > 0.0;
  for (int k = 0; k < 3; k++) {
    middle.normal[k] = pick(goes_on, half[k] / distance, normal[k]);
    middle.arm_i[k] = -lever_i * middle.normal[k];
    middle.arm_j[k] = lever_j * middle.normal[k];
  }
}

/** What is kept of a contact from step to step where its past does not follow from velocities (walls, grains that are
 *  no spheres), each of three numbers: the normal; the contact point against the middle of the two centres, or at a
 *  wall against that of i; and relative_velocity(), for evaluations that are repeated. */
enum Kept { kept_normal = 0, kept_point = 3, kept_velocity = 6, kept_numbers = 9 };

/** The middle of a step from what was kept at its beginning and is `now`, at its end. */
template <class Real>
GRAINSCOPE_INLINE void middle_of_kept(const Real *kept, const Moment<Real> &now, bool wall, const Motion<Real> &motion,
                                      double dt, Moment<Real> &middle) {
  Real sum[3];
  for (int k = 0; k < 3; k++) sum[k] = kept[kept_normal + k] + now.normal[k];
  const Real length = root(inner(sum, sum));
  const auto goes_on = inner(kept + kept_normal, now.normal) > 0.0;  // else it is a new contact
  for (int k = 0; k < 3; k++) {
    const Real branch = now.arm_j[k] - now.arm_i[k], half = 0.5 * (branch - (0.5 * dt) * motion.velocity[k]);
    const Real point = wall ? now.arm_i[k] : 0.5 * (now.arm_i[k] + now.arm_j[k]);
    const Real mean = 0.5 * (kept[kept_point + k] + point);
    middle.normal[k] = pick(goes_on, sum[k] / length, now.normal[k]);
    middle.arm_i[k] = pick(goes_on, wall ? mean : mean - half, now.arm_i[k]);
    middle.arm_j[k] = pick(goes_on, mean + half, now.arm_j[k]);
  }
}

/** All that is kept of a contact. */
template <class Real>
GRAINSCOPE_INLINE void keep(const Moment<Real> &now, bool wall, const Real *velocity, Real *kept) {
  for (int k = 0; k < 3; k++) {
    kept[kept_normal + k] = now.normal[k];
    kept[kept_point + k] = wall ? now.arm_i[k] : 0.5 * (now.arm_i[k] + now.arm_j[k]);
    kept[kept_velocity + k] = velocity[k];
  }
}

/** Of surface i against surface j in the middle of a step, turned to the normal at its end. */
template <class Real>
GRAINSCOPE_INLINE void relative_velocity(const Moment<Real> &middle, const Motion<Real> &motion, bool wall,
                                         const Real *normal, Real *velocity) {
  Real turn_i[3], turn_j[3] = {}, v[3];
  outer(motion.spin_i, middle.arm_i, turn_i);
  if (!wall) outer(motion.spin_j, middle.arm_j, turn_j);
  for (int k = 0; k < 3; k++) v[k] = motion.velocity[k] + turn_i[k] - turn_j[k];
  const Real along = inner(v, middle.normal);
  for (int k = 0; k < 3; k++) v[k] -= along * middle.normal[k];
  const Real by = inner(v, normal) / (1.0 + inner(middle.normal, normal));
  for (int k = 0; k < 3; k++) velocity[k] = along * normal[k] + v[k] - by * (middle.normal[k] + normal[k]);
}

/** A tangential spring, over the whole of the step: what lies across the normal at its beginning then lies across that
 *  at its end. */
template <class Real>
GRAINSCOPE_INLINE void turn_spring(const Moment<Real> &middle, Real *spring) {
  const Real twice = 2.0 * inner(spring, middle.normal);
  for (int k = 0; k < 3; k++) spring[k] -= twice * middle.normal[k];
}

}}

#endif

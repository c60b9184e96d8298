// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_HALF_STEP_H
#define GRAINSCOPE_HALF_STEP_H

#include "lanes.h"

/** `time_level synchronized`. Velocity Verlet evaluates forces at x_n with the velocities v_{n-1/2}. With normal and
 *  arms of x_n two surfaces that roll on each other then seem to slip. Here normal and arms are also those of n-1/2.
 *  The relative velocity of the surfaces is rotated from the normal at n-1/2 to that at x_n, where the force acts; the
 *  tangential spring is rotated from the normal of the step before. Both rotations are the shortest, which keeps
 *  lengths. */
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

/** Motion of two grains, or of a grain and a wall, whose spin is 0. */
template <class Real>
struct Motion {
  Real velocity[3];  // of the centre of i against that of j, or against the wall
  Real spin_i[3], spin_j[3];
};

/** v, turned as the shortest rotation turns the unit vector `from` to `to`. */
template <class Real>
GRAINSCOPE_INLINE void turn(const Real *from, const Real *to, const Real *v, Real *turned) {
  const Real along = inner(v, from);
  Real across[3];
  for (int k = 0; k < 3; k++) across[k] = v[k] - along * from[k];
  const Real by = inner(across, to) / (1.0 + inner(from, to));
  for (int k = 0; k < 3; k++) turned[k] = along * to[k] + across[k] - by * (from[k] + to[k]);
}

/** The normal in the middle of the step, `half`, and the velocity of surface i against surface j there, turned to
 *  `normal`: of two spheres, whose centres have moved by their velocities. `branch` = x_i - x_j; it and `normal`,
 *  towards i, are of the end of the step. */
template <class Real>
GRAINSCOPE_INLINE void of_spheres(const Real *normal, const Real *branch, Real radius_i, Real radius_j,
                                  const Motion<Real> &motion, double dt, Real *half, Real *velocity) {
  Real middle[3], levers[3], turning[3], v[3];
  for (int k = 0; k < 3; k++) middle[k] = branch[k] - (0.5 * dt) * motion.velocity[k];
  const Real distance = root(inner(middle, middle)), overlap = radius_i + radius_j - distance;
  const Real lever_i = radius_i - 0.5 * overlap, lever_j = radius_j - 0.5 * overlap;
  const auto goes_on = inner(middle, normal) > 0.0;
  for (int k = 0; k < 3; k++) {
    half[k] = pick(goes_on, middle[k] / distance, normal[k]);
    levers[k] = lever_i * motion.spin_i[k] + lever_j * motion.spin_j[k];
  }
  outer(levers, half, turning);
  for (int k = 0; k < 3; k++) v[k] = motion.velocity[k] - turning[k];
  turn(half, normal, v, velocity);
}

/** A contact at one moment, from i's side. */
template <class Real>
struct Moment {
  Real normal[3];           // towards i
  Real arm_i[3], arm_j[3];  // from the centres to the contact point; at a wall that of i alone has a meaning
};

/** What is kept of a contact from step to step where its past does not follow from velocities (walls, grains that are
 *  not spheres), three numbers each: the normal; the contact point relative to the middle of the two centres, or at a
 *  wall relative to the centre of i; and the velocity that was found, for evaluations that are repeated. */
enum Kept { kept_normal = 0, kept_point = 3, kept_velocity = 6, kept_numbers = 9 };

/** The same for any contact, from what was kept at the beginning of the step and from its state `now`, which is kept.
 */
template <class Real>
GRAINSCOPE_INLINE void of_kept(const Moment<Real> &now, bool wall, const Motion<Real> &motion, double dt, Real *kept,
                               Real *half, Real *velocity) {
  Real sum[3], arm_i[3], arm_j[3], turn_i[3], turn_j[3] = {}, v[3];
  for (int k = 0; k < 3; k++) sum[k] = kept[kept_normal + k] + now.normal[k];
  const Real length = root(inner(sum, sum));
  const Real *const normal_before = kept + kept_normal;
  const Real off = inner(normal_before, normal_before) - 1.0;
  // else it is a new contact
  const auto goes_on = (absolute(off) < 1e-6) & (inner(normal_before, now.normal) > 0.0);
  for (int k = 0; k < 3; k++) {
    const Real branch = now.arm_j[k] - now.arm_i[k], aside = 0.5 * (branch - (0.5 * dt) * motion.velocity[k]);
    const Real point = wall ? now.arm_i[k] : 0.5 * (now.arm_i[k] + now.arm_j[k]);
    const Real mean = 0.5 * (kept[kept_point + k] + point);
    half[k] = pick(goes_on, sum[k] / length, now.normal[k]);
    arm_i[k] = pick(goes_on, wall ? mean : mean - aside, now.arm_i[k]);
    arm_j[k] = pick(goes_on, mean + aside, now.arm_j[k]);
    kept[kept_normal + k] = now.normal[k];
    kept[kept_point + k] = point;
  }
  outer(motion.spin_i, arm_i, turn_i);
  if (!wall) outer(motion.spin_j, arm_j, turn_j);
  for (int k = 0; k < 3; k++) v[k] = motion.velocity[k] + turn_i[k] - turn_j[k];
  turn(half, now.normal, v, velocity);
  for (int k = 0; k < 3; k++) kept[kept_velocity + k] = velocity[k];
}

/** A tangential spring, over the whole of the step: what lies across the normal at its beginning then lies across that
 *  at its end. */
template <class Real>
GRAINSCOPE_INLINE void turn_spring(const Real *half, Real *spring) {
  const Real twice = 2.0 * inner(spring, half);
  for (int k = 0; k < 3; k++) spring[k] -= twice * half[k];
}

}}

#endif

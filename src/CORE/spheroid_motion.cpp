// SPDX-License-Identifier: GPL-2.0-or-later
#include "spheroid_motion.h"
#include "lane_rows.h"
#include "spheroid_rotation.h"
#include <algorithm>

namespace grainscope {

namespace {

/** Without vectors of four, what moves rows to columns and back costs more than the rest saves. */
GRAINSCOPE_INLINE bool has_fours() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

template <class Real>
GRAINSCOPE_INLINE bool in_group(const int *mask, int group) {
  for (int k = 1; k < ROWS<Real>; k++) group &= mask[k];
  return group & mask[0];
}

/** Grain i, or four from i on: unless they do not all move, or about another axis. */
template <bool drift, class Real>
GRAINSCOPE_INLINE bool move(const Spheroids &g, int i, double kick, double dt) {
  if (!in_group<Real>(g.mask + i, g.group)) return false;
  Real inertia[3], momentum[3], q[4], omega[3];
  read_threes(g.inertia + 3 * i, inertia);
  const int axis = axis_of_symmetric_top(inertia);
  if (axis < 0) return false;

  add_scaled_threes(kick / read_ones<Real>(g.mass + i), g.force + 3 * i, g.v + 3 * i);
  if (drift) add_threes<Real>(dt, g.v + 3 * i, g.x + 3 * i);
  add_threes<Real>(kick, g.torque + 3 * i, g.momentum + 3 * i);

  read_threes(g.momentum + 3 * i, momentum);
  read_fours(g.quaternion + 4 * i, q);
  if (drift) {
    rotate_freely(axis, inertia, momentum, dt, q, omega);
    write_fours(q, g.quaternion + 4 * i);
  } else angular_velocity(axis, inertia, momentum, q, omega);
  write_threes(omega, g.omega + 3 * i);
  return true;
}

/** Lanes by four from grain i on, up to those that are not moved side by side: where they begin. */
template <bool drift>
GRAINSCOPE_INLINE int move_fours(const Spheroids &grains, int i, double kick, double dt) {
  const Spheroids g = grains;  // of our own: no number that is written may be one of its pointers
  while (i + ROWS<Lanes> <= g.n && move<drift, Lanes>(g, i, kick, dt)) i += ROWS<Lanes>;
  return i;
}
GRAINSCOPE_CLONES int kick_fours(const Spheroids &grains, int i, double kick) {
  return move_fours<false>(grains, i, kick, 0.0);
}
GRAINSCOPE_CLONES int kick_and_drift_fours(const Spheroids &grains, int i, double kick, double dt) {
  return move_fours<true>(grains, i, kick, dt);
}

/** Grains alone are moved here, beyond the functions that are cloned: from those gcc may go on with vectors in use,
 *  which makes all that follows slow. */
template <bool drift>
void move_all(const Spheroids &grains, double kick, double dt) {
  const Spheroids g = grains;
  const bool fours = has_fours();
  for (int i = 0; i < g.n;) {
    if (fours) i = drift ? kick_and_drift_fours(grains, i, kick, dt) : kick_fours(grains, i, kick);
    const int last = fours ? std::min(i + ROWS<Lanes>, g.n) : g.n;
    for (; i < last; i++) move<drift, double>(g, i, kick, dt);
  }
}

}

void kick(const Spheroids &grains, double kick) { move_all<false>(grains, kick, 0.0); }

void kick_and_drift(const Spheroids &grains, double kick, double dt) { move_all<true>(grains, kick, dt); }

}

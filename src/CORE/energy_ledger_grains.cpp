// SPDX-License-Identifier: GPL-2.0-or-later
/** Grains in fours: the same as start_of_step() and end_of_step() of EnergyLedger for one grain. */
#include "energy_ledger.h"
#include "lane_rows.h"
#include "spheroid_rotation.h"
#include <algorithm>

namespace grainscope {

namespace {

GRAINSCOPE_INLINE Lanes dot(const Lanes *a, const Lanes *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

GRAINSCOPE_INLINE void rows_of(const Lanes *columns, Lanes *rows) {
  const Lanes four[4] = {columns[0], columns[1], columns[2], columns[2]};
  transpose(four, rows);
}

/** An AffineFlow. */
struct LaneFlow {
  Lanes xx, xy, xz, yy, yz, zz, centre[3];

  GRAINSCOPE_INLINE explicit LaneFlow(const AffineFlow &flow) {
    const Eigen::Matrix3d &l = flow.velocity_gradient;
    xx = lanes_of(l(0, 0));
    xy = lanes_of(l(0, 1));
    xz = lanes_of(l(0, 2));
    yy = lanes_of(l(1, 1));
    yz = lanes_of(l(1, 2));
    zz = lanes_of(l(2, 2));
    for (int a = 0; a < 3; a++) centre[a] = lanes_of(flow.centre[a]);
  }
  GRAINSCOPE_INLINE void gradient_times(const Lanes *r, Lanes *v) const {
    v[0] = xx * r[0] + xy * r[1] + xz * r[2];
    v[1] = yy * r[1] + yz * r[2];
    v[2] = zz * r[2];
  }
  GRAINSCOPE_INLINE void at(const Lanes *x, Lanes *v) const {
    Lanes r[3];
    for (int a = 0; a < 3; a++) r[a] = x[a] - centre[a];
    gradient_times(r, v);
  }
};

/** Angular momentum now, and angular velocity after a kick, of grains i to i + 3. */
GRAINSCOPE_INLINE void coming_spin_of_spheres(const EnergyLedger::Grains &g, int i, const Lanes &mass,
                                              const Lanes *torque, double kick, Lanes *momentum, Lanes *spin) {
  const Lanes radius = load(g.radius + i), inertia = g.inertia_factor * mass * radius * radius;
  Lanes omega[3];
  read_threes(g.omega + 3 * i, omega);
  for (int a = 0; a < 3; a++) {
    momentum[a] = inertia * omega[a];
    spin[a] = omega[a] + kick / inertia * torque[a];
  }
}
/** Likewise; false if they are not all symmetric tops about the same axis. Real is Lanes: templates take the alignment
 *  of what is theirs. */
template <class Real>
GRAINSCOPE_INLINE bool coming_spin_of_tops(const EnergyLedger::Grains &g, int i, const Lanes *torque, double kick,
                                           Lanes *momentum, Lanes *spin) {
  Real inertia[3], kicked[3], q[4], omega[3];
  read_threes(g.inertia + 3 * i, inertia);
  const int axis = axis_of_symmetric_top(inertia);
  if (axis < 0 || !all(are_symmetric_about(axis, inertia))) return false;
  read_threes(g.momentum + 3 * i, momentum);
  read_fours(g.quaternion + 4 * i, q);
  for (int a = 0; a < 3; a++) kicked[a] = momentum[a] + kick * torque[a];
  angular_velocity(axis, inertia, kicked, q, omega);
  for (int a = 0; a < 3; a++) spin[a] = omega[a];
  return true;
}

}

/** Rows of four numbers are read: there is a grain behind them. */
GRAINSCOPE_INLINE bool EnergyLedger::Grains::four_free(int i) const {
  if (i + LANES >= n) return false;
  int members = bit, some = 0;
  for (int k = 0; k < LANES; k++) {
    members &= mask[i + k];
    some |= mask[i + k];
  }
  return members && !(some & frozen);
}

GRAINSCOPE_CLONES
int EnergyLedger::end_of_step(const Grains &grains, int i, double dt) {
  const Grains g = grains;
  const LaneFlow flow(frame_);
  Lanes k_tr{}, k_rot{}, others{};  // of components
  for (; g.four_free(i); i += LANES) {
    Lanes x[3], carried[3], rows[LANES];
    read_threes(g.x + 3 * i, x);
    flow.at(x, carried);
    rows_of(carried, rows);
    Lanes force[LANES], torque[LANES];
    for (int k = 0; k < LANES; k++) {
      const int row = 3 * (i + k);
      force[k] = load(g.force + row);
      torque[k] = load(g.torque + row);
      rows[k] = load(g.v + row) - rows[k];
      const Lanes &p = rows[k], w = load(g.omega + row);
      k_tr += p * (g.mass[i + k] * p + dt * force[k]);
      if (g.momentum) {
        k_rot += w * (load(g.momentum + row) + dt * torque[k]);
      } else {
        const double inertia = g.inertia_factor * g.mass[i + k] * g.radius[i + k] * g.radius[i + k];
        k_rot += w * (inertia * w + dt * torque[k]);
      }
    }
    for (int slot = 0; slot < slots_; slot++) {
      if (!filled_[slot]) continue;
      const double *at = wrenches_of(i) + 8 * slot;
      for (int k = 0; k < LANES; k++, at += 8 * slots_) {
        force[k] -= load(at + 0);
        torque[k] -= load(at + 4);
      }
    }
    for (int k = 0; k < LANES; k++) others += force[k] * rows[k] + torque[k] * load(g.omega + 3 * (i + k));
  }
  ends_.k_tr += 0.5 * (k_tr[0] + k_tr[1] + k_tr[2]);
  ends_.k_rot += 0.5 * (k_rot[0] + k_rot[1] + k_rot[2]);
  add_to(ends_.other, others);
  return i;
}

/** The sums of Starts, lane by lane, but for those of components. */
struct EnergyLedger::LaneStarts {
  LaneFlow now, before, carried;
  Lanes drift[3]{}, stretch[3]{}, shear{}, box{}, k_old{}, k_carried{}, k_new{}, k_rot{};

  GRAINSCOPE_INLINE LaneStarts(const AffineFlow &now, const AffineFlow &before, const AffineFlow &carried)
      : now(now), before(before), carried(carried) {}

  GRAINSCOPE_INLINE void move_to(Starts &to) const {
    for (int a = 0; a < 3; a++) {
      to.drift[a] += sum_of(drift[a]);
      to.stretch[a] += sum_of(stretch[a]);
    }
    to.shear += sum_of(shear);
    to.box += sum_of(box);
    to.k_old += sum_of(k_old);
    to.k_carried += sum_of(k_carried);
    to.k_new += sum_of(k_new);
    to.k_rot += sum_of(k_rot);
  }
};

GRAINSCOPE_INLINE bool EnergyLedger::start_four(const Grains &g, int i, double dt, LaneStarts &sums) {
  const Lanes mass = load(g.mass + i);
  Lanes force[3], torque[3], momentum[3], spin[3];
  read_threes(g.torque + 3 * i, torque);
  if (!g.quaternion) coming_spin_of_spheres(g, i, mass, torque, 0.5 * dt, momentum, spin);
  else if (!coming_spin_of_tops<Lanes>(g, i, torque, 0.5 * dt, momentum, spin)) return false;
  for (int a = 0; a < 3; a++) momentum[a] -= 0.5 * dt * torque[a];
  sums.k_rot += 0.5 * dot(spin, momentum);

  Lanes x[3], v[3], flow[3], kick[3], p[3];
  read_threes(g.x + 3 * i, x);
  read_threes(g.v + 3 * i, v);
  read_threes(g.force + 3 * i, force);
  sums.now.at(x, flow);
  const Lanes by = 0.5 * dt / mass, half_mass = 0.5 * mass;
  Lanes now[3], peculiar[3];
  for (int a = 0; a < 3; a++) {
    kick[a] = by * force[a];
    now[a] = v[a] - flow[a];
    p[a] = now[a] + kick[a];
    peculiar[a] = now[a];
  }
  const Lanes kicked = dot(kick, kick);
  sums.k_new += half_mass * (dot(now, now) - kicked);
  if (driven_) {
    sums.carried.at(x, flow);
    for (int a = 0; a < 3; a++) peculiar[a] = v[a] - flow[a];
    sums.k_carried += half_mass * (dot(peculiar, peculiar) - kicked);
  }
  if (moved_) {
    Lanes old[3];
    sums.before.at(x, flow);
    for (int a = 0; a < 3; a++) {
      old[a] = v[a] - flow[a];
      sums.stretch[a] += half_mass * (peculiar[a] - old[a]) * (peculiar[a] + old[a]);
    }
    sums.k_old += half_mass * (dot(old, old) - kicked);
  }

  Lanes velocity[LANES], turning[LANES];
  rows_of(p, velocity);
  rows_of(spin, turning);
  Lanes other[LANES];
  for (int k = 0; k < LANES; k++) {
    const int row = 3 * (i + k);
    other[k] = load(g.force + row) * velocity[k] + load(g.torque + row) * turning[k];
  }
  for (int slot = 0; slot < slots_; slot++) {
    if (!filled_[slot]) continue;
    Lanes rate = load(starts_.rate[slot]);
    double *part = wrenches_of(i) + 8 * slot;
    for (int k = 0; k < LANES; k++, part += 8 * slots_) {
      const Lanes power = load(part + 0) * velocity[k] + load(part + 4) * turning[k];
      rate += power;
      other[k] -= power;
      std::fill(part, part + 8, 0.0);
    }
    grainscope::store(rate, starts_.rate[slot]);
  }
  for (int k = 0; k < LANES; k++) add_to(starts_.other, other[k]);

  // as start_of_step() has it
  Lanes after[3], drift[3], middle[3], lengths[3];
  for (int a = 0; a < 3; a++) after[a] = v[a] + kick[a];
  sums.now.gradient_times(after, drift);
  for (int a = 0; a < 3; a++) {
    drift[a] *= dt;
    middle[a] = mass * (p[a] - 0.5 * drift[a]);
  }
  lengths[0] = sums.now.xx * after[0] * middle[0];
  lengths[1] = sums.now.yy * after[1] * middle[1];
  lengths[2] = sums.now.zz * after[2] * middle[2];
  const Lanes box = dt * (lengths[0] + (lengths[1] + lengths[2]));
  for (int a = 0; a < 3; a++) sums.drift[a] += lengths[a];
  sums.box -= box;
  sums.shear -= dot(drift, middle) - box;
  return true;
}

GRAINSCOPE_CLONES
int EnergyLedger::start_of_step(const Grains &grains, int i, double dt) {
  const Grains g = grains;
  LaneStarts sums(next_, frame_, carried_);
  const int first = i;
  while (g.four_free(i) && start_four(g, i, dt, sums)) i += LANES;
  emptied_ += i - first;
  sums.move_to(starts_);
  return i;
}

}

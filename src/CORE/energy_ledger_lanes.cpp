// SPDX-License-Identifier: GPL-2.0-or-later
/** Contacts side by side: the same as EnergyLedger::add() for one contact. */
#include "energy_ledger.h"
#include "lane_vectors.h"
#include <algorithm>

namespace grainscope {

namespace {

GRAINSCOPE_INLINE Lanes dot(const Lanes *a, const Lanes *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

GRAINSCOPE_INLINE void cross(const Lanes *a, const Lanes *b, Lanes *c) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

GRAINSCOPE_INLINE void rows_of(const Lanes *columns, Lanes *rows) {
  const Lanes four[4] = {columns[0], columns[1], columns[2], columns[2]};
  transpose(four, rows);
}

GRAINSCOPE_INLINE LaneMask members_of(const PairGroup &group, const EnergyLedger::Members &members) {
  LaneMask in;
  for (int k = 0; k < LANES; k++) in[k] = members.mask[group.i[k]] & members.mask[group.j[k]] & members.bit ? -1 : 0;
  return in;
}

/** overlap^(exponent - 1). */
GRAINSCOPE_INLINE Lanes of_overlap(const Lanes &overlap, double exponent) {
  return exponent == 1.5 ? root(overlap) : exponent == 1.0 ? 1.0 + Lanes{} : pair_law::power(overlap, exponent - 1.0);
}

}

/** Contact points seen from the two grains, and where the forces on the grains are summed. */
struct EnergyLedger::LaneArms {
  Lanes weight;
  const Lanes *i;
  Lanes j[3], branch[3];              // branch: with the weight
  double *of_i[LANES], *of_j[LANES];  // of those that do not count, and of ghosts, in one place

  GRAINSCOPE_INLINE LaneArms(const ContactLanes &c, const Members &members, double *wrenches, std::ptrdiff_t stride,
                             int own)
      : weight(c.forces.weight), i(c.forces.arm) {
    LaneMask here = c.geometry.touching;
    if (!members.all()) {
      here &= members_of(c.group, members);
      weight = pick(here, weight, Lanes{});
    }
    for (int a = 0; a < 3; a++) {
      const Lanes r = c.branch(a);
      j[a] = i[a] + r;
      branch[a] = weight * r;
    }
    for (int k = 0; k < LANES; k++) {
      of_i[k] = wrenches + stride * (here[k] ? c.group.i[k] : own);
      of_j[k] = wrenches + stride * (here[k] ? std::min(c.group.j[k], own) : own);
    }
  }
  /** F_a r_b and F.u. */
  GRAINSCOPE_INLINE void moments(const Lanes *f, const Lanes &power, Lanes *m) const {
    for (int a = 0; a < 3; a++) m[a] = f[a] * branch[a];
    m[power_place] = weight * power;
    m[4] = f[1] * branch[2];
    m[5] = f[0] * branch[2];
    m[6] = f[0] * branch[1];
  }
};

/** Elastic and damping forces: so many times a unit force. */
GRAINSCOPE_INLINE void EnergyLedger::add_normal(const ContactLanes &c, const LaneArms &arms, const Lanes *sizes) {
  const Lanes *const n = c.forces.normal;
  Lanes moments[power_moments], torque[3], rows[LANES];
  arms.moments(n, c.forces.working_normal(), moments);
  for (int part = elastic; part <= damping; part++)
    for (int k = 0; k < power_moments; k++) lanes_.sums[part][k] += sizes[part] * moments[k];
  constexpr int at[2] = {8 * lane_slot(elastic), 8 * lane_slot(damping)};
  filled_[lane_slot(elastic)] = filled_[lane_slot(damping)] = true;
  rows_of(n, rows);
  for (int k = 0; k < LANES; k++)
    for (int part = elastic; part <= damping; part++) {
      const Lanes force = sizes[part][k] * rows[k];
      add_to(arms.of_i[k] + at[part], force);
      take_from(arms.of_j[k] + at[part], force);
    }
  cross(arms.i, n, torque);
  rows_of(torque, rows);
  for (int k = 0; k < LANES; k++)
    for (int part = elastic; part <= damping; part++) add_to(arms.of_i[k] + at[part] + 4, sizes[part][k] * rows[k]);
  cross(n, arms.j, torque);
  rows_of(torque, rows);
  for (int k = 0; k < LANES; k++)
    for (int part = elastic; part <= damping; part++) add_to(arms.of_j[k] + at[part] + 4, sizes[part][k] * rows[k]);
}

GRAINSCOPE_INLINE void EnergyLedger::add_tangential(Part part, int slot, const ContactLanes &c, const LaneArms &arms,
                                                    const Lanes *f) {
  Lanes moments[power_moments], torque[3], rows[LANES];
  arms.moments(f, dot(f, c.forces.working_tangential()), moments);
  for (int k = 0; k < power_moments; k++) lanes_.sums[part][k] += moments[k];
  const int at = 8 * slot;
  filled_[slot] = true;
  rows_of(f, rows);
  for (int k = 0; k < LANES; k++) {
    add_to(arms.of_i[k] + at, rows[k]);
    take_from(arms.of_j[k] + at, rows[k]);
  }
  cross(arms.i, f, torque);
  rows_of(torque, rows);
  for (int k = 0; k < LANES; k++) add_to(arms.of_i[k] + at + 4, rows[k]);
  cross(f, arms.j, torque);
  rows_of(torque, rows);
  for (int k = 0; k < LANES; k++) add_to(arms.of_j[k] + at + 4, rows[k]);
}

GRAINSCOPE_INLINE void EnergyLedger::add_past(const ContactLanes &c, const Lanes &weight, const Lanes &elastic_force) {
  const PastLanes &past = *c.past;
  const GroupForces &f = c.forces;
  lanes_.kept_elastic += weight * past.elastic_work;
  const Lanes base0 = of_overlap(past.overlap, law_.exponent), base1 = of_overlap(f.overlap, law_.exponent);
  const Lanes change = f.kn / base1 - past.elastic_force / (past.overlap * base0);
  const Lanes stiffer =
      0.5 * law_.energy_factor * (past.overlap * past.overlap * base0 + f.overlap * f.overlap * base1) * change;
  const Lanes path = 0.5 * (past.elastic_force + elastic_force) * (f.overlap - past.overlap);
  const LaneMask both = (past.overlap > 0.0) & (f.overlap > 0.0);
  lanes_.elastic_path += pick(past.known, weight * (path + pick(both, stiffer, Lanes{})), Lanes{});
}

GRAINSCOPE_INLINE void EnergyLedger::add_spring(const ContactLanes &c, const Lanes &weight) {
  const PastLanes &past = *c.past;
  const GroupForces &f = c.forces;
  const Lanes half = 0.5 * weight, before = half * past.tangential_stiffness, after = half * f.kt;
  Lanes mean[3], move[3];
  for (int a = 0; a < 3; a++) {
    mean[a] = before * f.before[a] + after * f.after[a];
    move[a] = f.after[a] - f.before[a];
  }
  Lanes travel = dot(mean, move);
  if (any(f.cut)) {
    Lanes cut[3];
    for (int a = 0; a < 3; a++) cut[a] = f.uncut[a] - f.after[a];
    const Lanes friction = pick(f.cut, dot(mean, cut), Lanes{});
    lanes_.friction += friction;
    travel += friction;
  }
  lanes_.travel += travel;
  const Lanes stiffening = (before - after) * dot(f.before, f.after);
  lanes_.stiffening += pick(past.known, stiffening, Lanes{});
  lanes_.revived += pick(past.known, Lanes{}, stiffening);
  lanes_.spring_energy += after * dot(f.after, f.after);
  lanes_.kept_energy += before * dot(f.before, f.before);
  lanes_.kept_spring += weight * past.spring_work;
}

GRAINSCOPE_CLONES
void EnergyLedger::add(const ContactLanes &c, const Members &members) {
  const GroupForces &f = c.forces;
  const LaneArms arms(c, members, wrenches_.data(), 8 * slots_, own_);
  const Lanes sizes[2] = {f.kn * f.overlap, c.normal_damping()};
  add_normal(c, arms, sizes);
  if (law_.viscous) {
    const Lanes against = c.tangential_damping(), along_normal = sizes[elastic] + sizes[damping];
    Lanes force[3];
    for (int a = 0; a < 3; a++) force[a] = f.force[a] - along_normal * f.normal[a];
    if (any(against > 0.0)) {
      Lanes drag[3];
      for (int a = 0; a < 3; a++) {
        drag[a] = -against * f.tangential_velocity[a];
        force[a] -= drag[a];
      }
      add_tangential(viscous, lane_slot(viscous), c, arms, drag);
    }
    add_tangential(law_.spring ? spring : sliding, lane_slot(spring), c, arms, force);
  }
  const Lanes force = arms.weight * sizes[elastic];
  lanes_.normal_energy += force * f.overlap * law_.energy_factor;
  lanes_.new_elastic -= pick(c.past->known, Lanes{}, 0.5 * c.dt * force * f.working_normal());
  add_past(c, arms.weight, sizes[elastic]);
  if (law_.spring) add_spring(c, arms.weight);
}

void EnergyLedger::LaneContacts::move_to(Contacts &to) {
  for (int part = 0; part < parts; part++)
    for (int k = 0; k < power_moments; k++) to.sums[part][k] += sum_of(sums[part][k]);
  to.normal_energy += sum_of(normal_energy);
  to.spring_energy += sum_of(spring_energy);
  to.elastic_path += sum_of(elastic_path);
  to.new_elastic += sum_of(new_elastic);
  to.kept_elastic += sum_of(kept_elastic);
  to.kept_spring += sum_of(kept_spring);
  to.kept_energy += sum_of(kept_energy);
  to.friction += sum_of(friction);
  to.stiffening += sum_of(stiffening);
  to.travel += sum_of(travel);
  to.revived += sum_of(revived);
  *this = LaneContacts();
}

void EnergyLedger::end_evaluation() { lanes_.move_to(now_.contacts[grains]); }

}

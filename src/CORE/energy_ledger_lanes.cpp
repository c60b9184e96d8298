// SPDX-License-Identifier: GPL-2.0-or-later
/** Contacts that the ledger is shown side by side: as EnergyLedger::add() has it of one. */
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

/** Where a contact is, seen from its two grains, and who is asked. */
struct EnergyLedger::LaneArms {
  LaneMask here;
  Lanes weight;
  Lanes branch[3];  // with the weight
  Lanes i[3], j[3];

  GRAINSCOPE_INLINE LaneArms(const ContactLanes &c, const Members &members)
      : here(c.geometry.touching), weight(c.forces.weight) {
    if (!members.all()) {
      here &= members_of(c.group, members);
      weight = pick(here, weight, Lanes{});
    }
    for (int a = 0; a < 3; a++) {
      const Lanes r = c.branch(a);
      i[a] = c.forces.arm[a];
      j[a] = i[a] + r;
      branch[a] = weight * r;
    }
  }
};

/** A force on i: its torques on both, lane after lane, and F_a r_b. */
struct EnergyLedger::LaneForce {
  Lanes force[LANES], torque_i[LANES], torque_j[LANES], moments[6];

  GRAINSCOPE_INLINE LaneForce(const Lanes *f, const LaneArms &arms) {
    Lanes torque[3];
    rows_of(f, force);
    cross(arms.i, f, torque);
    rows_of(torque, torque_i);
    cross(arms.j, f, torque);
    rows_of(torque, torque_j);
    const Lanes *const r = arms.branch;
    const Lanes products[6] = {f[0] * r[0], f[1] * r[1], f[2] * r[2], f[1] * r[2], f[0] * r[2], f[0] * r[1]};
    std::copy(products, products + 6, moments);
  }
};

GRAINSCOPE_INLINE void EnergyLedger::add_normal(const ContactLanes &c, const LaneArms &arms, const Lanes &elastic_force,
                                                const Lanes &damping_force) {
  const LaneForce unit(c.forces.normal, arms);
  const Lanes sizes[2] = {elastic_force, damping_force}, power = arms.weight * c.forces.normal_velocity;
  for (int part = elastic; part <= damping; part++) {
    Lanes *const sums = lanes_.sums[part];
    for (int k = 0; k < 6; k++) sums[k < 3 ? k : k + 1] += sizes[part] * unit.moments[k];
    sums[power_place] += sizes[part] * power;
  }
  for (int k = 0; k < LANES; k++) {
    if (!arms.here[k]) continue;
    double *const of_i = wrenches_of(c.group.i[k]), *const of_j = wrenches_of(std::min(c.group.j[k], own_));
    for (int part = elastic; part <= damping; part++) {
      const int at = 8 * slot_[grains][part];
      const Lanes size = lanes_of(sizes[part][k]), force = size * unit.force[k];
      add_to(of_i + at, force);
      add_to(of_i + at + 4, size * unit.torque_i[k]);
      take_from(of_j + at, force);
      take_from(of_j + at + 4, size * unit.torque_j[k]);
    }
  }
}

GRAINSCOPE_INLINE void EnergyLedger::add_tangential(int part, const ContactLanes &c, const LaneArms &arms,
                                                    const Lanes *force) {
  const LaneForce all(force, arms);
  Lanes *const sums = lanes_.sums[part];
  for (int k = 0; k < 6; k++) sums[k < 3 ? k : k + 1] += all.moments[k];
  sums[power_place] += arms.weight * dot(force, c.forces.tangential_velocity);
  const int at = 8 * slot_[grains][part];
  for (int k = 0; k < LANES; k++) {
    if (!arms.here[k]) continue;
    double *const of_i = wrenches_of(c.group.i[k]) + at, *const of_j = wrenches_of(std::min(c.group.j[k], own_)) + at;
    add_to(of_i, all.force[k]);
    add_to(of_i + 4, all.torque_i[k]);
    take_from(of_j, all.force[k]);
    take_from(of_j + 4, all.torque_j[k]);
  }
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
  cleared_ = false;
  const GroupForces &f = c.forces;
  const LaneArms arms(c, members);
  const Lanes elastic_force = f.kn * f.overlap, damping_force = c.normal_damping();
  add_normal(c, arms, elastic_force, damping_force);
  if (law_.viscous) {
    const Lanes against = c.tangential_damping(), along_normal = elastic_force + damping_force;
    Lanes force[3];
    for (int a = 0; a < 3; a++) force[a] = f.force[a] - along_normal * f.normal[a];
    if (any(against > 0.0)) {
      Lanes drag[3];
      for (int a = 0; a < 3; a++) {
        drag[a] = -against * f.tangential_velocity[a];
        force[a] -= drag[a];
      }
      add_tangential(viscous, c, arms, drag);
    }
    add_tangential(law_.spring ? spring : sliding, c, arms, force);
  }
  const Lanes force = arms.weight * elastic_force;
  lanes_.normal_energy += force * f.overlap * law_.energy_factor;
  lanes_.new_elastic -= pick(c.past->known, Lanes{}, 0.5 * c.dt * force * f.normal_velocity);
  add_past(c, arms.weight, elastic_force);
  if (law_.spring) add_spring(c, arms.weight);
}

void EnergyLedger::LaneContacts::move_to(Contacts &to) {
  for (int part = 0; part < parts; part++)
    for (int k = 0; k < 8; k++) to.sums[part][k] += sum_of(sums[part][k]);
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

// SPDX-License-Identifier: GPL-2.0-or-later
/** Input of the ledger: contacts and grains. */
#include "energy_ledger.h"
#include "lane_vectors.h"
#include "lanes.h"
#include <algorithm>
#include <cmath>

namespace grainscope {

using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/** overlap^(exponent - 1): k_n over it depends on curvature and material alone. */
double of_overlap(double overlap, double exponent) {
  return exponent == 1.5 ? std::sqrt(overlap) : exponent == 1.0 ? 1.0 : std::pow(overlap, exponent - 1.0);
}

/** The frame as it would be if the velocities of the edges had not been changed: velocities that keep a shear rate grow
 *  with the box, and lengths advance. */
LedgerFrame carried(const LedgerFrame &before, const LedgerFrame &after) {
  LedgerFrame frame = after;
  frame.velocity_gradient = before.velocity_gradient;
  frame.velocity_gradient.diagonal() = before.edge_rates.cwiseQuotient(after.edge_lengths);
  return frame;
}

}

EnergyLedger::Law::Law(const ContactLaw &law)
    : exponent(law.exponent), energy_factor(1.0 / (1.0 + law.exponent)),
      spring(law.tangential == TangentialLaw::spring), viscous(spring || law.tangential == TangentialLaw::viscous),
      rolling(law.rolls) {}

bool EnergyLedger::Law::has(Part part) const {
  switch (part) {
    case EnergyLedger::spring: return spring;
    case EnergyLedger::sliding: return viscous && !spring;
    case EnergyLedger::viscous: return viscous;
    case EnergyLedger::rolling: return rolling;
    default: return true;
  }
}

void EnergyLedger::set_laws(const ContactLaw &between_grains, const std::vector<const ContactLaw *> &with_walls) {
  wrenches_.clear();
  law_ = Law(between_grains);
  now_.contacts[walls] = Contacts();
  kinds_ = with_walls.empty() ? 1 : partners;
  slots_ = 0;
  for (int k = 0; k < parts; k++) slot_[grains][k] = law_.has(Part(k)) ? slots_++ : -1;
  for (int k = 0; k < parts; k++) {
    const bool used = std::any_of(with_walls.begin(), with_walls.end(),
                                  [k](const ContactLaw *law) { return Law(*law).has(Part(k)); });
    slot_[walls][k] = used ? slots_++ : -1;
  }
}

void EnergyLedger::begin_evaluation(int n_local, bool repeats) {
  const std::size_t row = 8 * slots_;
  // Whose membership ends between two steps is not shown to start_of_step(), which empties rows.
  if (emptied_ != own_ || std::any_of(filled_, filled_ + slots_, [](bool filled) { return filled; })) wrenches_.clear();
  else if (!wrenches_.empty()) std::fill(wrenches_.end() - row, wrenches_.end(), 0.0);  // that of ghosts
  own_ = n_local;
  wrenches_.resize((own_ + std::size_t(1)) * row, 0.0);
  std::fill(filled_, filled_ + slots_, false);
  now_.contacts[grains] = Contacts();
  lanes_ = LaneContacts();
  if (kinds_ > 1) {
    now_.contacts[walls] = Contacts();
    now_.walls.clear();
  }
  stepped_ = stepped_ && repeats;
}

/** A force along one direction: its work on the two grains, and what is summed of it. */
struct EnergyLedger::Unit {
  Lanes force, torque_i, torque_j, diagonal, beside;

  GRAINSCOPE_INLINE Unit(const Contact &c, const Vector3d &f, const Vector3d &arm_j, double power)
      : force(lanes_of(f)), torque_i(torque_of(c.motion->arm, f)), torque_j(torque_of(arm_j, f)) {
    const Vector3d &r = c.branch;
    const Lanes weight = lanes_of(c.weight);
    diagonal = weight * Lanes{f[0] * r[0], f[1] * r[1], f[2] * r[2], power};
    beside = weight * lanes_of(f[1] * r[2], f[0] * r[2], f[0] * r[1]);
  }
};

void EnergyLedger::WallContacts::clear() {
  std::fill(&places[0][0], &places[0][0] + 8 * parts, 0.0);
  std::fill(&force[0][0], &force[0][0] + 4 * parts, 0.0);
  touches.clear();
  moving = false;
}

GRAINSCOPE_INLINE void EnergyLedger::WallContacts::add(int part, const Contact &c, const Vector3d &f) {
  const Vector3d &at = c.motion->point;
  add_to(places[part], Lanes{f[0] * at[0], f[1] * at[1], f[2] * at[2], f.dot(c.wall().velocity)});
  add_to(places[part] + 4, lanes_of(f[1] * at[2], f[0] * at[2], f[0] * at[1]));
  add_to(force[part], lanes_of(f));
  touches.back().force[part] = f;
}

template <EnergyLedger::Partner partner>
GRAINSCOPE_INLINE void EnergyLedger::add_part(int part, double size, const Unit &unit, const Contact &c, double *of_i,
                                              double *of_j) {
  const Lanes times = lanes_of(size), force = times * unit.force;
  const int slot = slot_[partner][part], at = 8 * slot;
  filled_[slot] = true;
  double *const sums = now_.contacts[partner].sums[part];
  add_to(sums, times * unit.diagonal);
  add_to(sums + 4, times * unit.beside);
  add_to(of_i + at, force);
  add_to(of_i + at + 4, times * unit.torque_i);
  if (partner == walls) now_.walls.add(part, c, Vector3d(force[0], force[1], force[2]));
  if (partner == walls || !of_j) return;
  take_from(of_j + at, force);
  take_from(of_j + at + 4, times * unit.torque_j);
}

GRAINSCOPE_INLINE void EnergyLedger::add_past(Contacts &sums, const Law &law, const Contact &c, double elastic_force) {
  const ContactPast &past = *c.past;
  const double w = c.weight;
  sums.kept_elastic += w * past.elastic_work;
  double path = 0.5 * (past.elastic_force + elastic_force) * (c.overlap - past.overlap);
  const double base0 = of_overlap(past.overlap, law.exponent), base1 = of_overlap(c.overlap, law.exponent);
  if (past.overlap > 0.0 && c.overlap > 0.0) {
    // energy = factor d^2 base k, with k = k_n/base: the part of the stiffness that does not depend on the overlap
    const double change = c.motion->normal_stiffness / base1 - past.elastic_force / (past.overlap * base0);
    path += 0.5 * law.energy_factor * (past.overlap * past.overlap * base0 + c.overlap * c.overlap * base1) * change;
  }
  sums.elastic_path += w * path;
}

GRAINSCOPE_INLINE void EnergyLedger::add_spring(Contacts &sums, const Contact &c) {
  const ContactSpring &s = *c.spring;
  const double w = c.weight, k0 = c.past ? c.past->tangential_stiffness : 0.0, k1 = c.motion->tangential_stiffness;
  const Vector3d mean = 0.5 * w * (k0 * s.before + k1 * s.after);
  const double cut = c.sliding ? mean.dot(s.cut) : 0.0;
  sums.friction += cut;
  sums.travel += mean.dot(s.after - s.before) + cut;
  const double stiffening = -0.5 * w * (k1 - k0) * s.before.dot(s.after);
  if (c.past) {
    sums.stiffening += stiffening;
    sums.kept_spring += w * c.past->spring_work;
    sums.kept_energy += 0.5 * w * k0 * s.before.squaredNorm();
  } else {
    sums.revived += stiffening;
  }
}

template <EnergyLedger::Partner partner>
GRAINSCOPE_INLINE void EnergyLedger::add_contact(const Law &law, const Contact &c, double dt, bool springs_move) {
  Contacts &sums = now_.contacts[partner];
  const ContactMotion &m = *c.motion;
  const ContactVelocity u = c.working_velocity();
  const double elastic_force = m.normal_stiffness * c.overlap;
  const Vector3d arm_j = m.arm + c.branch;
  double *const of_i = wrenches_of(c.i), *of_j = nullptr;
  const PartnerGrain *const other = partner == grains ? std::get_if<PartnerGrain>(&c.partner) : nullptr;
  if (other && !other->ghost) of_j = wrenches_of(other->index);
  const Unit normal(c, c.normal, arm_j, u.normal);
  add_part<partner>(elastic, elastic_force, normal, c, of_i, of_j);
  add_part<partner>(damping, m.normal_damping, normal, c, of_i, of_j);
  if (law.viscous) {
    // In the first evaluation of a run LIGGGHTS does not rotate springs into the contact plane: they may have a
    // component along the normal.
    Vector3d force = c.force - (elastic_force + m.normal_damping) * c.normal;
    if (m.damped) {
      const Vector3d viscous_force = -m.tangential_damping * m.tangential_velocity;
      force -= viscous_force;
      add_part<partner>(viscous, 1.0, Unit(c, viscous_force, arm_j, viscous_force.dot(u.tangential)), c, of_i, of_j);
    }
    add_part<partner>(law.spring ? spring : sliding, 1.0, Unit(c, force, arm_j, force.dot(u.tangential)), c, of_i,
                      of_j);
  }
  if (law.rolling) {
    Unit unit(c, Vector3d::Zero(), arm_j, c.rolling->torque.dot(c.rolling->spin));
    unit.torque_i = unit.torque_j = lanes_of(c.rolling->torque);
    add_part<partner>(rolling, 1.0, unit, c, of_i, of_j);
  }
  sums.normal_energy += c.weight * elastic_force * c.overlap * law.energy_factor;
  if (law.spring) sums.spring_energy += 0.5 * c.weight * m.tangential_stiffness * c.spring->after.squaredNorm();
  if (!springs_move) return;
  if (c.past) add_past(sums, law, c, elastic_force);
  else sums.new_elastic -= 0.5 * dt * c.weight * elastic_force * u.normal;
  if (law.spring) add_spring(sums, c);
}

void EnergyLedger::add_with_wall(const Contact &c, int grain_id, double dt, bool springs_move) {
  const PartnerWall &wall = c.wall();
  Touch touch{grain_id, wall.wall, wall.triangle, wall.velocity, {}};
  for (Vector3d &force : touch.force) force.setZero();
  now_.walls.touches.push_back(touch);
  now_.walls.moving = now_.walls.moving || !wall.velocity.isZero(0.0);
  add_contact<walls>(Law(*c.law), c, dt, springs_move);
}

GRAINSCOPE_CLONES
void EnergyLedger::add(ContactSpan contacts, const Members &members, double dt, bool springs_move) {
  for (const Contact &c : contacts) {
    const int of_i = members.mask[c.i] & members.bit;
    if (const PartnerGrain *other = std::get_if<PartnerGrain>(&c.partner)) {
      if (of_i & members.mask[other->index]) add_contact<grains>(law_, c, dt, springs_move);
    } else if (of_i) {
      add_with_wall(c, members.ids[c.i], dt, springs_move);
    }
  }
}

GRAINSCOPE_CLONES
void EnergyLedger::end_of_step(const Grain &g, const double omega[3], const double momentum[3], double dt) {
  const Map<const Vector3d> force(g.force), torque(g.torque), w(omega), angular(momentum);
  const Vector3d p = Map<const Vector3d>(g.v) - frame_.flow(Map<const Vector3d>(g.x));
  ends_.k_tr += 0.5 * p.dot(g.mass * p + dt * force);
  ends_.k_rot += 0.5 * w.dot(angular + dt * torque);
  Lanes other_force = lanes_of(force), other_torque = lanes_of(torque);
  const double *at = wrenches_of(g.index);
  for (int k = 0; k < slots_; k++, at += 8) {
    if (!filled_[k]) continue;
    other_force -= load(at + 0);
    other_torque -= load(at + 4);
  }
  add_to(ends_.other, other_force * lanes_of(p) + other_torque * lanes_of(w));
}

void EnergyLedger::begin_start_of_step(const LedgerFrame &frame) {
  next_ = frame;
  emptied_ = 0;
  carried_ = carried(frame_, next_);
  moved_ = stepped_ && !(frame_ == carried_);
  driven_ = stepped_ && !(carried_ == next_);
  starts_ = Starts();
}

GRAINSCOPE_CLONES
void EnergyLedger::start_of_step(const Grain &g, const double omega_after[3], const double momentum[3], double dt) {
  const Map<const Vector3d> x(g.x), v(g.v), force(g.force), torque(g.torque), spin(omega_after);
  const Vector3d kick = 0.5 * dt / g.mass * force, flow = next_.flow(x), now = v - flow, p = now + kick;
  const auto kinetic = [&](const Vector3d &peculiar) {
    return 0.5 * g.mass * (peculiar.squaredNorm() - kick.squaredNorm());
  };
  starts_.k_new += kinetic(now);
  Vector3d carried = now;
  if (driven_) {
    carried = v - carried_.flow(x);
    starts_.k_carried += kinetic(carried);
  }
  if (moved_) {
    const Vector3d old = v - frame_.flow(x);
    starts_.k_old += kinetic(old);
    add_to(starts_.stretch, lanes_of(0.5 * g.mass) * lanes_of(carried - old) * lanes_of(carried + old));
  }
  starts_.k_rot += 0.5 * spin.dot(Map<const Vector3d>(momentum) - 0.5 * dt * torque);

  const Lanes velocity = lanes_of(p), turning = lanes_of(spin);
  Lanes other = lanes_of(force) * velocity + lanes_of(torque) * turning;
  double *part = wrenches_of(g.index);
  for (int k = 0; k < slots_; k++, part += 8) {
    if (!filled_[k]) continue;
    const Lanes power = load(part + 0) * velocity + load(part + 4) * turning;
    add_to(starts_.rate[k], power);
    other -= power;
    std::fill(part, part + 8, 0.0);
  }
  add_to(starts_.other, other);
  emptied_++;

  // The next drift in the frame. It is noted before the drift, because a grain that is wrapped afterwards takes on
  // another velocity.
  const Vector3d after = p + flow, drift = dt * next_.gradient_times(after), middle = g.mass * (p - 0.5 * drift);
  const Vector3d lengths = next_.velocity_gradient.diagonal().cwiseProduct(after).cwiseProduct(middle);
  const double all = drift.dot(middle), box = dt * (lengths[0] + (lengths[1] + lengths[2]));
  add_to(starts_.drift, lanes_of(lengths));
  starts_.box -= box;
  starts_.shear -= all - box;
}

void EnergyLedger::end_with_weight(const Grain &g, const Vector3d &weight) {
  const Map<const Vector3d> x(g.x), v(g.v);
  ends_.weight += weight.dot(v - frame_.flow(x));
}

void EnergyLedger::start_with_weight(const Grain &g, const Vector3d &weight, double dt) {
  const Map<const Vector3d> x(g.x), v(g.v), force(g.force);
  starts_.weight += weight.dot(v - next_.flow(x) + 0.5 * dt / g.mass * force);
}

void EnergyLedger::start_with_jump(const Grain &g, const Vector3d &given) {
  const Map<const Vector3d> x(g.x), v(g.v);
  const auto before_it = [&](const Vector3d &peculiar) { return g.mass * given.dot(0.5 * given - peculiar); };
  if (!driven_) return;  // a frame that goes on gives nothing
  const Vector3d carried = v - carried_.flow(x);
  starts_.k_carried += before_it(carried);
  if (!moved_) return;
  const Vector3d old = v - frame_.flow(x);
  starts_.k_old += before_it(old);
  for (int a = 0; a < 3; a++) starts_.stretch[a] -= g.mass * given[a] * (carried - old)[a];
}

double EnergyLedger::kinetic_in_step(const Grain &g, const double omega[3], const double momentum[3]) const {
  const Vector3d p = Map<const Vector3d>(g.v) - frame_.flow(Map<const Vector3d>(g.x));
  return 0.5 * (g.mass * p.squaredNorm() + Map<const Vector3d>(omega).dot(Map<const Vector3d>(momentum)));
}

double EnergyLedger::kinetic_between_steps(const Grain &g, const double omega_after[3], const double momentum[3],
                                           double dt) const {
  const Map<const Vector3d> force(g.force), torque(g.torque), spin(omega_after);
  const Vector3d p = Map<const Vector3d>(g.v) - frame_.flow(Map<const Vector3d>(g.x));
  return 0.5 * (g.mass * p.squaredNorm() - (0.25 * dt * dt / g.mass) * force.squaredNorm() +
                spin.dot(Map<const Vector3d>(momentum) - 0.5 * dt * torque));
}

}

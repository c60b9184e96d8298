// SPDX-License-Identifier: GPL-2.0-or-later
#include "energy_ledger.h"
#include "four.h"
#include "lanes.h"
#include <cmath>
#include <iterator>
#include <numeric>

namespace grainscope {

using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

double sum_of_three(const double *x) { return x[0] + x[1] + x[2]; }

/** L:M of two upper triangles, on the diagonal and off it. */
double on_diagonal(const Matrix3d &l, const double m[8]) { return l(0, 0) * m[0] + l(1, 1) * m[1] + l(2, 2) * m[2]; }
double off_diagonal(const Matrix3d &l, const double m[8]) { return l(1, 2) * m[4] + l(0, 2) * m[5] + l(0, 1) * m[6]; }

template <class Numbers>
double sum(const Numbers &numbers) {
  return std::accumulate(std::begin(numbers), std::end(numbers), 0.0);
}

/** overlap^(exponent - 1): k_n over it depends on curvature and material alone. */
double of_overlap(double overlap, double exponent) {
  return exponent == 1.5 ? std::sqrt(overlap) : exponent == 1.0 ? 1.0 : std::pow(overlap, exponent - 1.0);
}

/** As it would be had the velocities of the edges not been changed: those that keep a shear rate grow with the box,
 *  lengths move on. */
LedgerFrame carried(const LedgerFrame &before, const LedgerFrame &after) {
  LedgerFrame frame = after;
  frame.velocity_gradient = before.velocity_gradient;
  frame.velocity_gradient.diagonal() = before.edge_rates.cwiseQuotient(after.edge_lengths);
  return frame;
}

}

void EnergyLedger::set_law(const ContactLaw &law) {
  const bool spring = law.tangential == TangentialLaw::spring;
  law_ = {law.exponent, spring, spring || law.tangential == TangentialLaw::viscous, law.rolls};
  energy_factor_ = 1.0 / (1.0 + law.exponent);
  slots_ = 0;
  const bool used[parts] = {true, true, law_.spring || law_.viscous, law_.viscous, law_.rolling};
  for (int k = 0; k < parts; k++) slot_[k] = used[k] ? slots_++ : -1;
}

void EnergyLedger::begin_evaluation(int n_local, bool repeats) {
  if (!cleared_) wrenches_.clear();
  wrenches_.resize(8 * static_cast<std::size_t>(n_local) * slots_, 0.0);
  cleared_ = true;
  contacts_ = Contacts();
  stepped_ = stepped_ && repeats;
}

/** A force along one direction: what it does to its two grains, and what is summed of it. */
struct EnergyLedger::Unit {
  Four force, torque_i, torque_j, diagonal, beside;

  GRAINSCOPE_INLINE Unit(const Contact &c, const Vector3d &f, const Vector3d &arm_j, double power)
      : force(four_of(f)), torque_i(torque_of(c.motion->arm, f)), torque_j(torque_of(arm_j, f)) {
    const Vector3d &r = c.branch;
    const Four weight = four_times(c.weight);
    diagonal = weight * Four{f[0] * r[0], f[1] * r[1], f[2] * r[2], power};
    beside = weight * four_of(f[1] * r[2], f[0] * r[2], f[0] * r[1]);
  }
};

GRAINSCOPE_INLINE void EnergyLedger::add_part(int part, double size, const Unit &unit, double *of_i, double *of_j) {
  const Four times = four_times(size), force = times * unit.force;
  const int at = 8 * slot_[part];
  add_to(contacts_.sums[part], times * unit.diagonal);
  add_to(contacts_.sums[part] + 4, times * unit.beside);
  add_to(of_i + at, force);
  add_to(of_i + at + 4, times * unit.torque_i);
  if (!of_j) return;
  take_from(of_j + at, force);
  take_from(of_j + at + 4, times * unit.torque_j);
}

GRAINSCOPE_INLINE void EnergyLedger::add_past(const Contact &c, const ContactPast &past, double elastic_force) {
  const double w = c.weight;
  contacts_.kept_elastic += w * past.elastic_work;
  double path = 0.5 * (past.elastic_force + elastic_force) * (c.overlap - past.overlap);
  const double base0 = of_overlap(past.overlap, law_.exponent), base1 = of_overlap(c.overlap, law_.exponent);
  if (past.overlap > 0.0 && c.overlap > 0.0) {
    // energy = factor d^2 base k, with k = k_n/base: the part of the stiffness that does not depend on the overlap
    const double change = c.motion->normal_stiffness / base1 - past.elastic_force / (past.overlap * base0);
    path += 0.5 * energy_factor_ * (past.overlap * past.overlap * base0 + c.overlap * c.overlap * base1) * change;
  }
  contacts_.elastic_path += w * path;
}

GRAINSCOPE_INLINE void EnergyLedger::add_spring(const Contact &c) {
  const ContactSpring &s = *c.spring;
  const double w = c.weight, k0 = c.past ? c.past->tangential_stiffness : 0.0, k1 = c.motion->tangential_stiffness;
  const Vector3d mean = 0.5 * w * (k0 * s.before + k1 * s.after);
  const double cut = c.sliding ? mean.dot(s.cut) : 0.0;
  contacts_.friction += cut;
  contacts_.travel += mean.dot(s.after - s.before) + cut;
  const double stiffening = -0.5 * w * (k1 - k0) * s.before.dot(s.after);
  if (c.past) {
    contacts_.stiffening += stiffening;
    contacts_.kept_spring += w * c.past->spring_work;
    contacts_.kept_energy += 0.5 * w * k0 * s.before.squaredNorm();
  } else {
    contacts_.revived += stiffening;
  }
}

GRAINSCOPE_CLONES
void EnergyLedger::add(const Contact &c, double dt, bool springs_move) {
  cleared_ = false;
  const ContactMotion &m = *c.motion;
  const double elastic_force = m.normal_stiffness * c.overlap;
  const Vector3d arm_j = m.arm + c.branch;
  double *const of_i = wrenches_of(c.i), *const of_j = c.ghost() ? nullptr : wrenches_of(c.j());
  const Unit normal(c, c.normal, arm_j, m.normal_velocity);
  add_part(elastic, elastic_force, normal, of_i, of_j);
  add_part(damping, m.normal_damping, normal, of_i, of_j);
  if (slot_[spring] >= 0) {
    // In the first evaluation of a run the host does not turn springs into the contact plane: they may push along the
    // normal too.
    Vector3d force = c.force - (elastic_force + m.normal_damping) * c.normal;
    if (law_.viscous && m.damped) {
      const Vector3d viscous_force = -m.tangential_damping * m.tangential_velocity;
      force -= viscous_force;
      add_part(viscous, 1.0, Unit(c, viscous_force, arm_j, viscous_force.dot(m.tangential_velocity)), of_i, of_j);
    }
    add_part(spring, 1.0, Unit(c, force, arm_j, force.dot(m.tangential_velocity)), of_i, of_j);
  }
  if (law_.rolling) {
    Unit unit(c, Vector3d::Zero(), arm_j, c.rolling->torque.dot(c.rolling->spin));
    unit.torque_i = unit.torque_j = four_of(c.rolling->torque);
    add_part(rolling, 1.0, unit, of_i, of_j);
  }
  contacts_.normal_energy += c.weight * elastic_force * c.overlap * energy_factor_;
  if (law_.spring) contacts_.spring_energy += 0.5 * c.weight * m.tangential_stiffness * c.spring->after.squaredNorm();
  if (!springs_move) return;
  if (c.past) add_past(c, *c.past, elastic_force);
  else contacts_.new_elastic -= 0.5 * dt * c.weight * elastic_force * m.normal_velocity;
  if (law_.spring) add_spring(c);
}

GRAINSCOPE_CLONES
void EnergyLedger::end_of_step(const Grain &g, const double omega[3], const double momentum[3], double dt) {
  const Map<const Vector3d> force(g.force), torque(g.torque), w(omega), angular(momentum);
  const Vector3d p = Map<const Vector3d>(g.v) - frame_.flow(Map<const Vector3d>(g.x));
  ends_.k_tr += 0.5 * p.dot(g.mass * p + dt * force);
  ends_.k_rot += 0.5 * w.dot(angular + dt * torque);
  Four other_force = four_of(force), other_torque = four_of(torque);
  const double *at = wrenches_of(g.index);
  for (int k = 0; k < slots_; k++, at += 8) {
    other_force -= four_at(at + 0);
    other_torque -= four_at(at + 4);
  }
  add_to(ends_.other, other_force * four_of(p) + other_torque * four_of(w));
}

/** Taken from the grains in the half step before an evaluation. */
double EnergyLedger::half_work(const Contacts &contacts, int part, double dt) {
  return -0.5 * dt * contacts.sums[part][power_place];
}

void EnergyLedger::book_step(double dt) {
  Entries step{};
  double work[parts];
  step[W_box] = starts_.box;
  step[W_shear] = starts_.shear;
  for (int k = 0; k < parts; k++) {
    work[k] = starts_.work[k] + half_work(contacts_, k, dt);
    for (const Contacts *end : {&before_, &contacts_}) {
      step[W_box] -= 0.5 * dt * on_diagonal(frame_.velocity_gradient, end->sums[k]);
      step[W_shear] -= 0.5 * dt * off_diagonal(frame_.velocity_gradient, end->sums[k]);
    }
  }
  step[W_other] = 0.5 * dt * (sum_of_three(starts_.other) + sum_of_three(ends_.other));
  step[D_n] = work[damping];
  step[D_damp] = work[viscous];
  step[D_rolling] = work[rolling];
  const double path =
      contacts_.elastic_path + contacts_.new_elastic + half_work(before_, elastic, dt) - contacts_.kept_elastic;
  step[G_n] = work[elastic] - path;
  step[G_dt] = path - (contacts_.normal_energy - before_.normal_energy);
  if (law_.spring) {
    const double last_half = half_work(before_, spring, dt) - contacts_.kept_spring;
    step[D_t] = contacts_.friction;
    step[G_k] = contacts_.stiffening;
    step[G_p] = work[spring] - contacts_.travel - last_half;
    step[G_open] = before_.spring_energy - contacts_.kept_energy + last_half + contacts_.revived;
  } else {
    step[D_t] = work[spring];
  }
  for (int k = 0; k < entries; k++) {
    last_[k] = between_[k] + step[k];
    totals_[k] += last_[k];
  }
  between_.fill(0.0);
  stored_before_ = ended_;
  ended_ = stored_ = {contacts_.normal_energy, contacts_.spring_energy, ends_.k_tr, ends_.k_rot};
  stepped_ = true;
}

void EnergyLedger::begin_start_of_step(const LedgerFrame &frame) {
  next_ = frame;
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
  if (driven_) starts_.k_carried += kinetic(v - carried_.flow(x));
  if (moved_) starts_.k_old += kinetic(v - frame_.flow(x));
  starts_.k_rot += 0.5 * spin.dot(Map<const Vector3d>(momentum) - 0.5 * dt * torque);

  const Four velocity = four_of(p), turning = four_of(spin);
  Four other = four_of(force) * velocity + four_of(torque) * turning;
  for (int k = 0; k < parts; k++) {
    if (slot_[k] < 0) continue;
    double *part = wrenches_of(g.index) + 8 * slot_[k];
    const Four power = four_at(part + 0) * velocity + four_at(part + 4) * turning;
    add_to(starts_.rate[k], power);
    other -= power;
    std::fill(part, part + 8, 0.0);
  }
  add_to(starts_.other, other);

  // The coming drift in the frame: noted before it, because a grain that is wrapped afterwards takes on another
  // velocity.
  const Vector3d after = p + flow, drift = dt * next_.gradient_times(after), middle = g.mass * (p - 0.5 * drift);
  const double all = drift.dot(middle), box = dt * next_.velocity_gradient.diagonal().cwiseProduct(after).dot(middle);
  starts_.box -= box;
  starts_.shear -= all - box;
}

void EnergyLedger::book_start(double dt) {
  for (int k = 0; k < parts; k++) {
    const double flow = on_diagonal(next_.velocity_gradient, contacts_.sums[k]) +
                        off_diagonal(next_.velocity_gradient, contacts_.sums[k]);
    starts_.work[k] = -0.5 * dt * (sum_of_three(starts_.rate[k]) + flow);
  }
  cleared_ = true;
  if (stepped_) {
    const double carried = driven_ ? starts_.k_carried : starts_.k_new, old = moved_ ? starts_.k_old : carried;
    between_[W_other] += old - stored_[K_tr] + starts_.k_rot - stored_[K_rot];
    between_[W_box] += carried - old;
    between_[W_frame] += starts_.k_new - carried;
    stored_[K_tr] = starts_.k_new;
    stored_[K_rot] = starts_.k_rot;
  } else {  // forces were recomputed: a run begins
    stored_ = {contacts_.normal_energy, contacts_.spring_energy, starts_.k_new, starts_.k_rot};
    if (started_) {
      between_[W_other] += sum(stored_) - sum(ended_);
    } else {
      start_energy_ = sum(stored_);
      ended_ = stored_;
    }
    started_ = true;
  }
  before_ = contacts_;
  frame_ = next_;
}

}

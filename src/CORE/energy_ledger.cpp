// SPDX-License-Identifier: GPL-2.0-or-later
#include "energy_ledger.h"
#include "lanes.h"
#include <cmath>
#include <numeric>

namespace grainscope {

using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/** L:M of two upper triangles, on the diagonal and off it. */
double on_diagonal(const Matrix3d &l, const double m[6]) { return l(0, 0) * m[0] + l(1, 1) * m[1] + l(2, 2) * m[2]; }
double off_diagonal(const Matrix3d &l, const double m[6]) { return l(1, 2) * m[3] + l(0, 2) * m[4] + l(0, 1) * m[5]; }

template <class Numbers>
double sum(const Numbers &numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), 0.0);
}

/** overlap^(exponent - 1): k_n over it depends on curvature and material alone. */
double of_overlap(double overlap, double exponent) {
  return exponent == 1.5 ? std::sqrt(overlap) : exponent == 1.0 ? 1.0 : std::pow(overlap, exponent - 1.0);
}

/** As it would be had the velocities of the edges not been changed: those that keep a shear rate grow with the box, lengths move on. */
LedgerFrame carried(const LedgerFrame &before, const LedgerFrame &after) {
  LedgerFrame frame = after;
  frame.gradient = before.gradient;
  frame.gradient.diagonal() = before.edge_rates.cwiseQuotient(after.edge_lengths);
  return frame;
}

}

void EnergyLedger::set_law(const LedgerLaw &law) {
  law_ = law;
  energy_factor_ = 1.0 / (1.0 + law.exponent);
  slots_ = 0;
  const bool used[parts] = {true, true, law.spring || law.viscous, law.viscous, law.rolling};
  for (int k = 0; k < parts; k++) slot_[k] = used[k] ? slots_++ : -1;
}

void EnergyLedger::begin_evaluation(int n_local) {
  if (!cleared_) wrenches_.clear();
  wrenches_.resize(8 * static_cast<std::size_t>(n_local) * slots_, 0.0);
  cleared_ = true;
  contacts_ = Contacts();
  stepped_ = false;
}

namespace {

/** Force and torque about a centre. */
GRAINSCOPE_INLINE Lanes wrench_of(const Vector3d &f, const Vector3d &arm) {
  return Lanes{f[0], f[1], f[2], arm[1] * f[2] - arm[2] * f[1], arm[2] * f[0] - arm[0] * f[2], arm[0] * f[1] - arm[1] * f[0], 0.0, 0.0};
}

/** What is summed of a force over contacts (upper triangle: the flow's gradient has no other), `power` being F.u. */
GRAINSCOPE_INLINE Lanes sums_of(const Contact &c, const Vector3d &f, double power) {
  const Vector3d &r = c.branch;
  return c.weight * Lanes{f[0] * r[0], f[1] * r[1], f[2] * r[2], f[1] * r[2], f[0] * r[2], f[0] * r[1], power, 0.0};
}

/** Power of a wrench. */
GRAINSCOPE_INLINE double power(const double wrench[6], const Vector3d &v, const Vector3d &omega) {
  return wrench[0] * v[0] + wrench[1] * v[1] + wrench[2] * v[2] + wrench[3] * omega[0] + wrench[4] * omega[1] + wrench[5] * omega[2];
}

/** Lanes where the allocator put them. */
typedef double LanesInMemory __attribute__((vector_size(8 * LANES), aligned(8), may_alias));
GRAINSCOPE_INLINE LanesInMemory &lanes_at(double *memory) { return *reinterpret_cast<LanesInMemory *>(memory); }

}

template <class Lanes>
GRAINSCOPE_INLINE void EnergyLedger::add_part(const Contact &c, int part, Lanes on_i, Lanes on_j, Lanes sums) {
  lanes_at(contacts_.sums[part]) += sums;
  lanes_at(wrench(c.i, part)) += on_i;
  if (!c.ghost) lanes_at(wrench(c.j, part)) -= on_j;
}

GRAINSCOPE_INLINE void EnergyLedger::add_tangential(const Contact &c, int part, const Vector3d &force, const Vector3d &arm_j) {
  add_part(c, part, wrench_of(force, c.arm), wrench_of(force, arm_j), sums_of(c, force, force.dot(c.tangential_velocity)));
}

GRAINSCOPE_INLINE void EnergyLedger::add_past(const Contact &c, const ContactPast &past, double elastic_force) {
  const double w = c.weight;
  contacts_.kept_elastic += w * past.elastic_work;
  double path = 0.5 * (past.elastic_force + elastic_force) * (c.overlap - past.overlap);
  const double base0 = of_overlap(past.overlap, law_.exponent), base1 = of_overlap(c.overlap, law_.exponent);
  if (base0 > 0.0 && base1 > 0.0) {
    // energy = factor d^2 base k, with k = k_n/base: what is left of the stiffness once the overlap is told
    const double change = c.normal_stiffness / base1 - past.elastic_force / (past.overlap * base0);
    path += 0.5 * energy_factor_ * (past.overlap * past.overlap * base0 + c.overlap * c.overlap * base1) * change;
  }
  contacts_.elastic_path += w * path;
}

GRAINSCOPE_INLINE void EnergyLedger::add_spring(const Contact &c, const ContactPast &past) {
  const double w = c.weight, k0 = past.tangential_stiffness, k1 = c.tangential_stiffness;
  const Vector3d mean = 0.5 * w * (k0 * c.spring_before + k1 * c.spring);
  const double cut = c.sliding ? mean.dot(c.cut) : 0.0;
  contacts_.friction += cut;
  contacts_.travel += mean.dot(c.spring - c.spring_before) + cut;
  const double stiffening = -0.5 * w * (k1 - k0) * c.spring_before.dot(c.spring);
  if (past.touched) {
    contacts_.stiffening += stiffening;
    contacts_.kept_spring += w * past.spring_work;
    contacts_.kept_energy += 0.5 * w * k0 * c.spring_before.squaredNorm();
  } else {
    contacts_.revived += stiffening;
  }
}

GRAINSCOPE_CLONES
void EnergyLedger::add(const Contact &c, double dt, bool springs_move) {
  cleared_ = false;
  const double elastic_force = c.normal_stiffness * c.overlap;
  const Vector3d arm_j = c.arm + c.branch;
  const Lanes on_i = wrench_of(c.normal, c.arm), on_j = wrench_of(c.normal, arm_j), sums = sums_of(c, c.normal, c.normal_velocity);
  add_part(c, elastic, elastic_force * on_i, elastic_force * on_j, elastic_force * sums);
  add_part(c, damping, c.normal_damping * on_i, c.normal_damping * on_j, c.normal_damping * sums);
  if (slot_[spring] >= 0) {
    Vector3d force = c.tangential_force;
    if (law_.viscous && !c.sliding && c.tangential_damping != 0.0) {
      const Vector3d viscous_force = -c.tangential_damping * c.tangential_velocity;
      force -= viscous_force;
      add_tangential(c, viscous, viscous_force, arm_j);
    }
    add_tangential(c, spring, force, arm_j);
  }
  if (law_.rolling) {
    const Vector3d &t = c.rolling_torque;
    const Lanes torque{0.0, 0.0, 0.0, t[0], t[1], t[2], 0.0, 0.0};
    add_part(c, rolling, torque, torque, sums_of(c, Vector3d::Zero(), t.dot(c.spin)));
  }
  contacts_.normal_energy += c.weight * elastic_force * c.overlap * energy_factor_;
  if (law_.spring) contacts_.spring_energy += 0.5 * c.weight * c.tangential_stiffness * c.spring.squaredNorm();
  if (!springs_move) return;
  static const ContactPast none;
  const ContactPast &past = c.past ? *c.past : none;
  if (past.touched) add_past(c, past, elastic_force);
  else contacts_.new_elastic -= 0.5 * dt * c.weight * elastic_force * c.normal_velocity;
  if (law_.spring) add_spring(c, past);
}

void EnergyLedger::end_of_step(const Grain &g, const double omega[3], const double momentum[3], double dt) {
  const Map<const Vector3d> force(g.force), torque(g.torque), w(omega), angular(momentum);
  const Vector3d p = Map<const Vector3d>(g.v) - frame_.flow(Map<const Vector3d>(g.x));
  ends_.k_tr += 0.5 * p.dot(g.mass * p + dt * force);
  ends_.k_rot += 0.5 * w.dot(angular + dt * torque);
  double other = force.dot(p) + torque.dot(w);
  const double *at = &wrenches_[8 * static_cast<std::size_t>(g.index) * slots_];
  for (int k = 0; k < slots_; k++) other -= power(at + 8 * k, p, w);
  ends_.other += 0.5 * dt * other;
}

/** Taken from the grains in the half step before an evaluation. */
double EnergyLedger::half_work(const Contacts &contacts, int part, double dt) { return -0.5 * dt * contacts.sums[part][power_lane]; }

void EnergyLedger::book_step(double dt) {
  Entries step{};
  double work[parts];
  step[W_box] = starts_.box;
  step[W_shear] = starts_.shear;
  for (int k = 0; k < parts; k++) {
    work[k] = starts_.work[k] + half_work(contacts_, k, dt);
    for (const Contacts *end : {&before_, &contacts_}) {
      step[W_box] -= 0.5 * dt * on_diagonal(frame_.gradient, end->sums[k]);
      step[W_shear] -= 0.5 * dt * off_diagonal(frame_.gradient, end->sums[k]);
    }
  }
  step[W_other] = starts_.other + ends_.other;
  step[D_n] = work[damping];
  step[D_damp] = work[viscous];
  step[D_rolling] = work[rolling];
  const double path = contacts_.elastic_path + contacts_.new_elastic + half_work(before_, elastic, dt) - contacts_.kept_elastic;
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
  stored_before_ = stored_;
  stored_ = {contacts_.normal_energy, contacts_.spring_energy, ends_.k_tr, ends_.k_rot};
  last_energy_ = sum(stored_);
  stepped_ = true;
}

void EnergyLedger::begin_start_of_step(const LedgerFrame &frame) {
  next_ = frame;
  carried_ = carried(frame_, next_);
  moved_ = stepped_ && !(frame_ == carried_);
  driven_ = stepped_ && !(carried_ == next_);
  starts_ = Starts();
}

void EnergyLedger::start_of_step(const Grain &g, const double omega_after[3], const double momentum[3], double dt) {
  const Map<const Vector3d> x(g.x), v(g.v), force(g.force), torque(g.torque), spin(omega_after);
  const Vector3d kick = 0.5 * dt / g.mass * force, flow = next_.flow(x), now = v - flow, p = now + kick;
  const auto kinetic = [&](const Vector3d &peculiar) { return 0.5 * g.mass * (peculiar.squaredNorm() - kick.squaredNorm()); };
  starts_.k_new += kinetic(now);
  if (driven_) starts_.k_carried += kinetic(v - carried_.flow(x));
  if (moved_) starts_.k_old += kinetic(v - frame_.flow(x));
  if (!stepped_) starts_.k_rot += 0.5 * spin.dot(Map<const Vector3d>(momentum) - 0.5 * dt * torque);

  double other = force.dot(p) + torque.dot(spin);
  for (int k = 0; k < parts; k++) {
    if (slot_[k] < 0) continue;
    double *part = wrench(g.index, k);
    const double rate = power(part, p, spin);
    starts_.rate[k] += rate;
    other -= rate;
    std::fill(part, part + 8, 0.0);
  }
  starts_.other += 0.5 * dt * other;

  // The coming drift in the frame: told before it, because a grain that is wrapped afterwards takes on another velocity.
  const Vector3d after = p + flow, drift = dt * next_.gradient_times(after), middle = g.mass * (p - 0.5 * drift);
  const double all = drift.dot(middle), box = dt * next_.gradient.diagonal().cwiseProduct(after).dot(middle);
  starts_.box -= box;
  starts_.shear -= all - box;
}

void EnergyLedger::book_start(double dt) {
  for (int k = 0; k < parts; k++)
    starts_.work[k] = -0.5 * dt * (starts_.rate[k] + on_diagonal(next_.gradient, contacts_.sums[k]) + off_diagonal(next_.gradient, contacts_.sums[k]));
  cleared_ = true;
  if (stepped_) {
    const double carried = driven_ ? starts_.k_carried : starts_.k_new, old = moved_ ? starts_.k_old : carried;
    between_[W_other] += old - stored_[K_tr];
    between_[W_box] += carried - old;
    between_[W_frame] += starts_.k_new - carried;
    stored_[K_tr] = starts_.k_new;
  } else {  // forces were evaluated anew: a run begins
    stored_ = {contacts_.normal_energy, contacts_.spring_energy, starts_.k_new, starts_.k_rot};
    const double energy = sum(stored_);
    if (started_) between_[W_other] += energy - last_energy_;
    else start_energy_ = energy;
    started_ = true;
  }
  before_ = contacts_;
  frame_ = next_;
}

EnergyLedger::Entries EnergyLedger::totals() const {
  Entries sums = totals_;
  for (int k = 0; k < entries; k++) sums[k] += between_[k];
  return sums;
}

double EnergyLedger::residual(const Entries &totals, double stored_change) {
  double supplied = 0.0, gone = 0.0;
  for (int k = W_shear; k <= W_other; k++) supplied += totals[k];
  for (int k = D_n; k < entries; k++) gone += totals[k];
  return supplied - gone - stored_change;
}

std::array<double, EnergyLedger::state_size> EnergyLedger::state() const {
  std::array<double, state_size> state;
  const Entries booked = totals();
  std::copy(booked.begin(), booked.end(), state.begin());
  state[entries] = start_energy_;
  state[entries + 1] = last_energy_;
  return state;
}

void EnergyLedger::restore(const std::array<double, state_size> &state) {
  std::copy(state.begin(), state.begin() + entries, totals_.begin());
  start_energy_ = state[entries];
  last_energy_ = state[entries + 1];
  started_ = true;
}

}

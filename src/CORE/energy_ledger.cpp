// SPDX-License-Identifier: GPL-2.0-or-later
#include "energy_ledger.h"
#include <cmath>
#include <numeric>

namespace grainscope {

using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

double inner(const Matrix3d &a, const Matrix3d &b) { return a.cwiseProduct(b).sum(); }

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

double kinetic(double mass, const Vector3d &before, const Vector3d &after) { return 0.5 * mass * before.dot(after); }

}

void EnergyLedger::set_law(const LedgerLaw &law) {
  law_ = law;
  slots_ = 0;
  const bool used[parts] = {true, true, law.spring || law.viscous, law.viscous, law.rolling};
  for (int k = 0; k < parts; k++) slot_[k] = used[k] ? slots_++ : -1;
}

void EnergyLedger::begin_evaluation(int n_local) {
  wrenches_.assign(static_cast<std::size_t>(n_local) * slots_ * 6, 0.0);
  contacts_ = Contacts();
  stepped_ = false;
}

inline void EnergyLedger::add_wrench(int i, Part part, const Vector3d &force, const Vector3d &arm) {
  double *at = wrench(i, part);
  Map<Vector3d>(at + 0) += force;
  Map<Vector3d>(at + 3) += arm.cross(force);
}

void EnergyLedger::add(const Contact &c, double dt, bool springs_move) {
  const double half = 0.5 * dt * c.weight;
  const double elastic_force = c.normal_stiffness * c.overlap;
  const Vector3d viscous_force = c.sliding || !law_.viscous ? Vector3d(Vector3d::Zero()) : Vector3d(-c.tangential_damping * c.tangential_velocity);
  const Vector3d forces[4] = {elastic_force * c.normal, c.normal_damping * c.normal, c.tangential_force - viscous_force, viscous_force};
  const double powers[4] = {elastic_force * c.normal_velocity, c.normal_damping * c.normal_velocity,
                            forces[spring].dot(c.tangential_velocity), viscous_force.dot(c.tangential_velocity)};
  const Vector3d arm_j = c.arm + c.branch;
  for (int k = elastic; k <= viscous; k++) {
    if (slot_[k] < 0) continue;
    contacts_.work[k] -= half * powers[k];
    contacts_.moment[k] += (c.weight * forces[k]) * c.branch.transpose();
    add_wrench(c.i, static_cast<Part>(k), forces[k], c.arm);
    if (!c.ghost) add_wrench(c.j, static_cast<Part>(k), -forces[k], arm_j);
  }
  if (law_.rolling) {
    contacts_.work[rolling] -= half * c.rolling_torque.dot(c.spin);
    Map<Vector3d>(wrench(c.i, rolling) + 3) += c.rolling_torque;
    if (!c.ghost) Map<Vector3d>(wrench(c.j, rolling) + 3) -= c.rolling_torque;
  }
  contacts_.normal_energy += c.weight * elastic_force * c.overlap / (1.0 + law_.exponent);
  if (law_.spring) contacts_.spring_energy += c.weight * 0.5 * c.tangential_stiffness * c.spring.squaredNorm();
  if (!springs_move) return;
  static const ContactPast none;
  const ContactPast &past = c.past ? *c.past : none;
  if (past.touched) add_past(c, past, elastic_force);
  else contacts_.new_elastic -= half * powers[elastic];
  if (law_.spring) add_spring(c, past);
}

void EnergyLedger::add_past(const Contact &c, const ContactPast &past, double elastic_force) {
  const double w = c.weight;
  contacts_.kept_elastic += w * past.elastic_work;
  contacts_.elastic_path += w * 0.5 * (past.elastic_force + elastic_force) * (c.overlap - past.overlap);
  const double base0 = of_overlap(past.overlap, law_.exponent), base1 = of_overlap(c.overlap, law_.exponent);
  if (base0 == 0.0 || base1 == 0.0) return;
  const double k0 = past.elastic_force / (past.overlap * base0), k1 = c.normal_stiffness / base1;
  const double energy0 = past.overlap * past.overlap * base0, energy1 = c.overlap * c.overlap * base1;  // (1 + exponent) dU/dk
  contacts_.elastic_path += w * 0.5 * (energy0 + energy1) * (k1 - k0) / (1.0 + law_.exponent);
}

void EnergyLedger::add_spring(const Contact &c, const ContactPast &past) {
  const double w = c.weight, k0 = past.tangential_stiffness, k1 = c.tangential_stiffness;
  const Vector3d mean = 0.5 * (k0 * c.spring_before + k1 * c.spring);
  contacts_.friction += w * mean.dot(c.cut);
  contacts_.travel += w * mean.dot(c.spring - c.spring_before + c.cut);
  const double stiffening = -0.5 * w * (k1 - k0) * c.spring_before.dot(c.spring);
  if (past.touched) {
    contacts_.stiffening += stiffening;
    contacts_.kept_spring += w * past.spring_work;
    contacts_.kept_energy += w * 0.5 * k0 * c.spring_before.squaredNorm();
  } else {
    contacts_.revived += stiffening;
  }
}

void EnergyLedger::end_of_step(const Grain &g, double dt) {
  const Vector3d p = g.v - frame_.flow(g.x), after = p + dt / g.mass * g.force;
  ends_.k_tr += kinetic(g.mass, p, after);
  ends_.k_rot += 0.5 * (g.angular_momentum + dt * g.torque).dot(g.omega);

  Vector3d force = g.force, torque = g.torque;
  for (int k = 0; k < slots_; k++) {
    const double *at = &wrenches_[(static_cast<std::size_t>(g.index) * slots_ + k) * 6];
    force -= Map<const Vector3d>(at);
    torque -= Map<const Vector3d>(at + 3);
  }
  ends_.other += 0.5 * dt * (force.dot(p) + torque.dot(g.omega));
}

void EnergyLedger::book_step(double dt) {
  Entries step{};
  Matrix3d moment = Matrix3d::Zero();
  double work[parts];
  for (int k = 0; k < parts; k++) {
    work[k] = starts_.work[k] + contacts_.work[k];
    moment += before_.moment[k] + contacts_.moment[k];
  }
  const Matrix3d virial = -0.5 * dt * frame_.gradient.cwiseProduct(moment);
  step[W_box] = virial.trace() + starts_.box;
  step[W_shear] = virial.sum() - virial.trace() + starts_.shear;
  step[W_other] = starts_.other + ends_.other;
  step[D_n] = work[damping];
  step[D_damp] = work[viscous];
  step[D_rolling] = work[rolling];
  const double path = contacts_.elastic_path + contacts_.new_elastic + before_.work[elastic] - contacts_.kept_elastic;
  step[G_n] = work[elastic] - path;
  step[G_dt] = path - (contacts_.normal_energy - before_.normal_energy);
  if (law_.spring) {
    const double last_half = before_.work[spring] - contacts_.kept_spring;
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
  starts_ = Starts();
}

void EnergyLedger::start_of_step(const Grain &g, double dt) {
  const Vector3d kick = 0.5 * dt / g.mass * g.force, before = g.v - kick, after = g.v + kick, spin = g.omega + 0.5 * dt * g.spin_up;
  const Vector3d flow = next_.flow(g.x), p = after - flow;
  starts_.k_new += kinetic(g.mass, before - flow, p);
  starts_.k_rot += 0.5 * (g.angular_momentum + 0.5 * dt * g.torque).dot(g.omega - 0.5 * dt * g.spin_up);
  if (stepped_) {
    const Vector3d old = frame_.flow(g.x), same = carried(frame_, next_).flow(g.x);
    starts_.k_old += kinetic(g.mass, before - old, after - old);
    starts_.k_carried += kinetic(g.mass, before - same, after - same);
  }
  Vector3d force = g.force, torque = g.torque;
  for (int k = 0; k < parts; k++) {
    if (slot_[k] < 0) continue;
    const double *at = wrench(g.index, static_cast<Part>(k));
    const Map<const Vector3d> part_force(at), part_torque(at + 3);
    starts_.work[k] -= 0.5 * dt * (part_force.dot(p) + part_torque.dot(spin));
    force -= part_force;
    torque -= part_torque;
  }
  starts_.other += 0.5 * dt * (force.dot(p) + torque.dot(spin));

  // The coming drift in the frame: told before it, because a grain that is wrapped afterwards takes on another velocity.
  const Matrix3d &l = next_.gradient;
  const Vector3d stretched = l.diagonal().cwiseProduct(after), sheared = l * after - stretched;
  const Vector3d middle = p - 0.5 * dt * (stretched + sheared);
  starts_.box -= dt * g.mass * stretched.dot(middle);
  starts_.shear -= dt * g.mass * sheared.dot(middle);
}

void EnergyLedger::book_start(double dt) {
  for (int k = 0; k < parts; k++) starts_.work[k] -= 0.5 * dt * inner(next_.gradient, contacts_.moment[k]);
  if (stepped_) {
    between_[W_other] += starts_.k_old - stored_[K_tr];
    between_[W_box] += starts_.k_carried - starts_.k_old;
    between_[W_frame] += starts_.k_new - starts_.k_carried;
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

double EnergyLedger::residual(const Entries &totals, double stored_change) {
  double supplied = 0.0, gone = 0.0;
  for (int k = W_shear; k <= W_other; k++) supplied += totals[k];
  for (int k = D_n; k < entries; k++) gone += totals[k];
  return supplied - gone - stored_change;
}

std::array<double, EnergyLedger::state_size> EnergyLedger::state() const {
  std::array<double, state_size> state;
  std::copy(totals_.begin(), totals_.end(), state.begin());
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

// SPDX-License-Identifier: GPL-2.0-or-later
/** How the ledger books its input, what it reports, and what restart files hold of it. */
#include "energy_ledger.h"
#include <algorithm>
#include <iterator>
#include <numeric>
#include <tuple>

namespace grainscope {

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

}

/** Taken from the grains in the half step before an evaluation. */
double EnergyLedger::half_work(const Contacts &contacts, int part, double dt) {
  return -0.5 * dt * contacts.sums[part][power_place];
}

/** F.P of a part, P the wall's velocity against the flow at the contact point. */
double EnergyLedger::wall_power(const WallContacts &sums, int part, const LedgerFrame &frame) {
  const double *const places = sums.places[part], *const force = sums.force[part];
  const Matrix3d &l = frame.velocity_gradient;
  const Vector3d centre = l * frame.centre;
  return places[power_place] - on_diagonal(l, places) - off_diagonal(l, places) + force[0] * centre[0] +
         force[1] * centre[1] + force[2] * centre[2];
}

/** Energies of contacts with one kind of partner in the step, and the work of the box on them. */
void EnergyLedger::book_contacts(Partner partner, double dt, Entries &step) const {
  const Contacts &before = before_.contacts[partner], &now = now_.contacts[partner];
  double work[parts];
  for (int k = 0; k < parts; k++) {
    work[k] = starts_.work[partner][k] + half_work(now, k, dt);
    for (const Contacts *end : {&before, &now}) {
      step[W_box] -= 0.5 * dt * on_diagonal(frame_.velocity_gradient, end->sums[k]);
      step[W_shear] -= 0.5 * dt * off_diagonal(frame_.velocity_gradient, end->sums[k]);
      for (int a = 0; a < 3; a++) step[W_box_x + a] -= 0.5 * dt * frame_.velocity_gradient(a, a) * end->sums[k][a];
    }
  }
  const double path = now.elastic_path + now.new_elastic + half_work(before, elastic, dt) - now.kept_elastic;
  const double last_half = half_work(before, spring, dt) - now.kept_spring;
  step[D_n] = work[damping];
  step[D_t] = now.friction + work[sliding];
  step[D_damp] = work[viscous];
  step[D_rolling] = work[rolling];
  step[G_k] = now.stiffening;
  step[G_p] = work[spring] - now.travel - last_half;
  step[G_n] = work[elastic] - path;
  step[G_open] = before.spring_energy - now.kept_energy + last_half + now.revived;
  step[G_dt] = path - (now.normal_energy - before.normal_energy);
}

bool EnergyLedger::Touch::operator<(const Touch &other) const {
  return std::tie(grain, wall, triangle) < std::tie(other.grain, other.wall, other.triangle);
}

/** The velocity of the wall at the beginning of the step is that of the step before. For a grain that has moved from
 *  one triangle to another it is the velocity of the new triangle. */
void EnergyLedger::take_velocity_of_step(double dt) {
  WallContacts &before = before_.walls, &now = now_.walls;
  if (!before.moving && !now.moving) return;
  std::sort(now.touches.begin(), now.touches.end());
  for (const Touch &touch : before.touches) {
    auto at = std::lower_bound(now.touches.begin(), now.touches.end(), touch);
    const auto goes_on = [&touch](const Touch &one) { return one.grain == touch.grain && one.wall == touch.wall; };
    if (at == now.touches.end() || !goes_on(*at)) {
      if (at == now.touches.begin() || !goes_on(*--at)) continue;
    }
    for (int k = 0; k < parts; k++) {
      const double change = touch.force[k].dot(at->velocity - touch.velocity);
      before.places[k][power_place] += change;
      starts_.work[walls][k] += 0.5 * dt * change;
    }
  }
}

void EnergyLedger::book_walls(double dt, Entries &step) {
  take_velocity_of_step(dt);
  Entries of_walls{};
  book_contacts(walls, dt, of_walls);
  for (int k = W_shear; k <= G_dt; k++) step[k] += of_walls[k];
  for (int k = W_box_x; k <= W_box_z; k++) step[k] += of_walls[k];
  for (int k = D_n; k <= D_rolling; k++) step[D_n_w + k - D_n] = of_walls[k];
  for (int k = G_k; k <= G_dt; k++) step[G_w] += of_walls[k];
  for (int k = 0; k < parts; k++)
    step[W_wall] += 0.5 * dt * (wall_power(before_.walls, k, frame_) + wall_power(now_.walls, k, frame_));
}

void EnergyLedger::store(double k_tr, double k_rot) {
  const Contacts &of_grains = now_.contacts[grains], &of_walls = now_.contacts[walls];
  stored_ = {of_grains.normal_energy + of_walls.normal_energy,
             of_grains.spring_energy + of_walls.spring_energy,
             k_tr,
             k_rot,
             of_walls.normal_energy,
             of_walls.spring_energy};
}

void EnergyLedger::book_step(double dt) {
  Entries step{};
  step[W_box] = starts_.box;
  for (int a = 0; a < 3; a++) step[W_box_x + a] = -dt * starts_.drift[a];
  step[W_shear] = starts_.shear;
  book_contacts(grains, dt, step);
  if (kinds_ > 1) book_walls(dt, step);
  step[W_gravity] = 0.5 * dt * (starts_.weight + ends_.weight);
  step[W_other] = 0.5 * dt * (sum_of_three(starts_.other) + sum_of_three(ends_.other)) - step[W_gravity];
  for (int k = 0; k < entries; k++) {
    last_[k] = between_[k] + passed_[k] + step[k];
    totals_[k] += last_[k];
  }
  between_.fill(0.0);
  passed_.fill(0.0);
  stored_before_ = ended_;
  store(ends_.k_tr, ends_.k_rot);
  ended_ = stored_;
  stepped_ = true;
}

void EnergyLedger::book_start(double dt) {
  for (int partner = 0; partner < kinds_; partner++)
    for (int k = 0; k < parts; k++) {
      const int slot = slot_[partner][k];
      if (slot < 0) continue;
      const double *const sums = now_.contacts[partner].sums[k];
      double flow = on_diagonal(next_.velocity_gradient, sums) + off_diagonal(next_.velocity_gradient, sums);
      if (partner == walls) flow -= wall_power(now_.walls, k, next_);
      starts_.work[partner][k] = -0.5 * dt * (sum_of_three(starts_.rate[slot]) + flow);
    }
  std::fill(filled_, filled_ + slots_, false);
  if (stepped_) {
    const double carried = driven_ ? starts_.k_carried : starts_.k_new, old = moved_ ? starts_.k_old : carried;
    between_[W_other] += old - stored_[K_tr] + starts_.k_rot - stored_[K_rot];
    between_[W_box] += carried - old;
    for (int a = 0; a < 3; a++) between_[W_box_x + a] += starts_.stretch[a];
    between_[W_frame] += starts_.k_new - carried;
    stored_[K_tr] = starts_.k_new;
    stored_[K_rot] = starts_.k_rot;
  } else {  // forces were recomputed: a run begins
    store(starts_.k_new, starts_.k_rot);
    if (started_) {
      between_[W_other] += energy(stored_) - energy(ended_);
    } else {
      start_energy_ = energy(stored_);
      ended_ = stored_;
    }
    started_ = true;
  }
  before_.contacts[grains] = now_.contacts[grains];
  if (kinds_ > 1) {
    before_.contacts[walls] = now_.contacts[walls];
    before_.walls = now_.walls;
  }
  frame_ = next_;
}

double EnergyLedger::Passage::all() const { return kinetic + sum(normal) + sum(spring); }

/** Without this the energy stored in a contact whose grain left would count as lost, as if the contact had opened. */
void EnergyLedger::pass_in_step(const Passage &out, const Passage &in) {
  passed_[W_in] = in.all();
  passed_[W_out] = out.all();
  passed_[G_dt] = sum(in.normal) - sum(out.normal);
  passed_[G_open] = sum(in.spring) - sum(out.spring);
  passed_[G_w] = in.normal[walls] - out.normal[walls] + in.spring[walls] - out.spring[walls];
}

/** The stored energy has changed by them; the change was booked as work from outside, or will be. */
void EnergyLedger::pass_between_steps(const Passage &out, const Passage &in) {
  between_[W_in] += in.all();
  between_[W_out] += out.all();
  between_[W_other] += out.all() - in.all();
}

EnergyLedger::Entries EnergyLedger::totals() const {
  Entries sums = totals_;
  for (int k = 0; k < entries; k++) sums[k] += between_[k];
  return sums;
}

double EnergyLedger::residual(const Entries &totals, double stored_change) {
  double supplied = 0.0, gone = 0.0;
  for (int k = W_shear; k <= W_other; k++) supplied += totals[k];
  for (int k : {W_wall, W_gravity, W_in}) supplied += totals[k];
  for (int k = D_n; k <= G_dt; k++) gone += totals[k];
  return supplied - gone - totals[W_out] - stored_change;
}

double EnergyLedger::energy(const Stores &stored) { return stored[U_n] + stored[U_t] + stored[K_tr] + stored[K_rot]; }

EnergyLedger::State EnergyLedger::state() const {
  State state;
  const Entries booked = totals();
  auto at = state.begin();
  at = std::copy(booked.begin(), booked.end(), at);
  at = std::copy(last_.begin(), last_.end(), at);
  at = std::copy(ended_.begin(), ended_.end(), at);
  at = std::copy(stored_before_.begin(), stored_before_.end(), at);
  *at = start_energy_;
  return state;
}

void EnergyLedger::restore(const State &state, const LedgerFrame &frame) {
  auto at = state.begin();
  const auto take = [&at](auto &numbers) {
    for (double &one : numbers) one = *at++;
  };
  between_.fill(0.0);
  take(totals_);
  take(last_);
  take(ended_);
  take(stored_before_);
  start_energy_ = *at;
  stored_ = ended_;
  frame_ = frame;
  started_ = stepped_ = true;
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "energy_ledger.h"
#include "make_contact.h"
#include <gtest/gtest.h>
#include <cmath>

namespace {

using Eigen::Vector3d;
using grainscope::Contact;
using grainscope::ContactPast;
using grainscope::EnergyLedger;
using grainscope::LedgerFrame;
using E = EnergyLedger;

/** A sphere that moves by kick, drift, kick; its velocities are those that the ledger is shown. */
struct Sphere {
  double mass, inertia;
  Vector3d x, v, omega, force = Vector3d::Zero(), torque = Vector3d::Zero();

  void kick(double dt) {
    v += 0.5 * dt / mass * force;
    omega += 0.5 * dt / inertia * torque;
  }
  EnergyLedger::Grain shown(int index) const { return {index, mass, x.data(), v.data(), force.data(), torque.data()}; }
};

/** Two spheres under a law of this test's own: an elastic force k d^(3/2), damping c d^(1/4) u_n, a tangential spring of stiffness h d^(1/2)
 *  with friction; and a constant force from outside. The ledger is told what it would be told by the pair style. */
class Pair {
 public:
  static constexpr double radius = 1.0, k = 1e4, c = 30.0, h = 8e3, friction = 0.3;
  const double dt;
  Sphere spheres[2] = {{2.0, 0.8, {-1.01, 0.05, 0.0}, {0.6, 0.0, 0.1}, {0.0, 0.3, 0.9}}, {3.0, 1.1, {1.0, 0.0, 0.1}, {-0.4, 0.1, 0.0}, {0.2, 0.0, 0.5}}};
  EnergyLedger ledger;
  LedgerFrame frame;
  Vector3d outside = Vector3d::Zero();
  bool touching = false, touched = false;

  explicit Pair(double step = 1e-3) : dt(step) { ledger.set_law({1.5, true, false, false}); }

  void evaluate(bool springs_move) {
    Sphere &i = spheres[0], &j = spheres[1];
    i.force = outside;
    j.force = Vector3d::Zero();
    i.torque = j.torque = Vector3d::Zero();
    ledger.begin_evaluation(2);
    const Vector3d r = i.x - j.x, n = r.normalized();
    const double d = 2.0 * radius - r.norm();
    touching = d > 0.0;
    if (!touching) {
      past_ = ContactPast();
      spring_.setZero();
      return;
    }
    touched = true;
    Contact contact{};
    contact.j = 1;
    contact.weight = 1.0;
    contact.branch = r;
    contact.normal = n;
    contact.overlap = d;
    contact.arm = -(radius - 0.5 * d) * n;
    const Vector3d u = i.v - j.v + i.omega.cross(contact.arm) - j.omega.cross(contact.arm + r);
    contact.normal_velocity = u.dot(n);
    contact.tangential_velocity = u - u.dot(n) * n;
    contact.normal_stiffness = k * std::sqrt(d);
    contact.tangential_stiffness = h * std::sqrt(d);
    contact.normal_damping = -c * std::sqrt(std::sqrt(d)) * u.dot(n);
    contact.spring_before = spring_;
    Vector3d tried = spring_;
    if (springs_move) {
      tried += dt * contact.tangential_velocity;
      tried -= tried.dot(n) * n;
    }
    contact.normal_force = contact.normal_stiffness * d + contact.normal_damping;
    const double limit = friction * std::fabs(contact.normal_force) / contact.tangential_stiffness;
    contact.sliding = tried.norm() > limit;
    spring_ = contact.sliding ? Vector3d(limit / tried.norm() * tried) : tried;
    contact.spring = spring_;
    contact.cut = tried - spring_;
    contact.tangential_force = -contact.tangential_stiffness * spring_;
    contact.force = contact.normal_force * n + contact.tangential_force;
    contact.past = &past_;
    ledger.add(contact, dt, springs_move);
    past_ = {true, d, contact.normal_stiffness * d, contact.tangential_stiffness, -0.5 * dt * contact.normal_stiffness * d * u.dot(n),
             0.5 * dt * contact.tangential_stiffness * spring_.dot(contact.tangential_velocity)};
    i.force += contact.force;
    j.force -= contact.force;
    i.torque += contact.arm.cross(contact.force);
    j.torque -= (contact.arm + r).cross(contact.force);
  }

  void step(const Vector3d &unseen_kick = Vector3d::Zero()) {
    ledger.begin_start_of_step(frame);
    for (int g = 0; g < 2; g++) {
      const Sphere &s = spheres[g];
      const Vector3d momentum = s.inertia * s.omega, after = s.omega + 0.5 * dt / s.inertia * s.torque;
      ledger.start_of_step(s.shown(g), after.data(), momentum.data(), dt);
    }
    ledger.book_start(dt);
    for (Sphere &s : spheres) s.kick(dt);
    spheres[0].v += unseen_kick;
    for (Sphere &s : spheres) s.x += dt * s.v;
    evaluate(true);
    ledger.begin_end_of_step();
    for (int g = 0; g < 2; g++) {
      const Sphere &s = spheres[g];
      const Vector3d momentum = s.inertia * s.omega;
      ledger.end_of_step(s.shown(g), s.omega.data(), momentum.data(), dt);
    }
    ledger.book_step(dt);
    for (Sphere &s : spheres) s.kick(dt);
  }

  double residual() const {
    double stored = 0.0;
    for (double one : ledger.stored()) stored += one;
    return E::residual(ledger.totals(), stored - ledger.start_energy());
  }
  double kinetic() const {
    double sum = 0.0;
    for (const Sphere &s : spheres) sum += 0.5 * s.mass * s.v.squaredNorm() + 0.5 * s.inertia * s.omega.squaredNorm();
    return sum;
  }

 private:
  Vector3d spring_ = Vector3d::Zero();
  ContactPast past_;
};

/** Rounding of a thousand sums of numbers below 3. */
const double rounding = 1e-13;

TEST(energy_ledger, a_collision_loses_what_the_ledger_says) {
  Pair pair;
  pair.evaluate(false);
  const double before = pair.kinetic();
  for (int n = 0; n < 400; n++) pair.step();
  ASSERT_TRUE(pair.touched && !pair.touching);
  const auto totals = pair.ledger.totals();
  double lost = 0.0;
  for (int k = E::D_n; k < E::entries; k++) lost += totals[k];
  EXPECT_NEAR(lost, before - pair.kinetic(), rounding);
  EXPECT_NEAR(pair.residual(), 0.0, rounding);
  EXPECT_GT(totals[E::D_n], 0.05);
  EXPECT_GT(totals[E::D_t], 0.005);
  EXPECT_NE(totals[E::G_k], 0.0);
  EXPECT_EQ(totals[E::W_shear], 0.0);
}

TEST(energy_ledger, work_from_outside_is_force_times_path) {
  Pair pair;
  pair.outside = Vector3d(0.5, -1.0, 0.2);
  pair.evaluate(false);
  const Vector3d start = pair.spheres[0].x;
  for (int n = 0; n < 400; n++) pair.step();
  EXPECT_NEAR(pair.ledger.totals()[E::W_other], pair.outside.dot(pair.spheres[0].x - start), rounding);
  EXPECT_NEAR(pair.residual(), 0.0, rounding);
}

TEST(energy_ledger, a_kick_behind_its_back_is_the_residual) {
  Pair pair;
  pair.evaluate(false);
  for (int n = 0; n < 100; n++) pair.step();
  const Vector3d kick(0.01, 0.0, 0.0);
  const Vector3d v = pair.spheres[0].v + 0.5 * pair.dt / pair.spheres[0].mass * pair.spheres[0].force;
  const double given = pair.spheres[0].mass * kick.dot(v + 0.5 * kick);
  pair.step(kick);
  EXPECT_NEAR(pair.residual(), -given, rounding);  // they part: no force works on it
}

TEST(energy_ledger, a_kick_between_steps_comes_from_outside) {
  Pair pair;
  pair.evaluate(false);
  for (int n = 0; n < 30; n++) pair.step();
  const Vector3d kick(0.01, -0.02, 0.0);
  const double given = pair.spheres[0].mass * kick.dot(pair.spheres[0].v + 0.5 * kick);
  pair.spheres[0].v += kick;
  pair.step();
  EXPECT_NEAR(pair.ledger.totals()[E::W_other], given, rounding);
  EXPECT_NEAR(pair.residual(), 0.0, rounding);
}

TEST(energy_ledger, energies_of_another_frame_close_too) {
  Pair pair;
  pair.frame.gradient << 0.1, 0.7, -0.2, 0.0, -0.3, 0.4, 0.0, 0.0, 0.2;
  pair.frame.edge_lengths << 8.0, 9.0, 10.0;
  pair.frame.edge_rates = pair.frame.gradient.diagonal().cwiseProduct(pair.frame.edge_lengths);
  pair.frame.centre << 0.3, -0.1, 0.2;
  pair.evaluate(false);
  for (int n = 0; n < 200; n++) pair.step();
  const auto totals = pair.ledger.totals();
  EXPECT_GT(std::fabs(totals[E::W_shear]) + std::fabs(totals[E::W_box]), 0.01);
  EXPECT_NEAR(pair.residual(), 0.0, rounding);
  EXPECT_EQ(totals[E::W_frame], 0.0);
}

TEST(energy_ledger, a_changed_frame_is_told_apart_from_a_box_that_moves_on) {
  Pair pair;
  pair.frame.edge_lengths << 10.0, 10.0, 10.0;
  pair.frame.gradient(1, 1) = 0.1;
  pair.frame.edge_rates[1] = 1.0;
  pair.evaluate(false);
  pair.step();
  pair.frame.edge_lengths[1] += pair.dt;  // the same velocity of the edge, a longer box: a smaller gradient
  pair.frame.gradient(1, 1) = 1.0 / pair.frame.edge_lengths[1];
  pair.step();
  EXPECT_EQ(pair.ledger.totals()[E::W_frame], 0.0);
  double expected = 0.0;
  for (const Sphere &s : pair.spheres) {
    const double y = s.x[1], p = s.v[1] - pair.frame.gradient(1, 1) * y, q = s.v[1] - 0.2 * y;
    expected += 0.5 * s.mass * (q * q - p * p);
  }
  pair.frame.gradient(1, 1) = 0.2;
  pair.step();
  EXPECT_NEAR(pair.ledger.totals()[E::W_frame], expected, rounding);
  EXPECT_NEAR(pair.residual(), 0.0, rounding);
}

TEST(energy_ledger, the_error_of_the_step_is_of_second_order) {
  double error[2];
  for (int halved = 0; halved < 2; halved++) {
    Pair pair(halved ? 1e-3 : 2e-3);
    pair.evaluate(false);
    for (int n = 0; n < (halved ? 400 : 200); n++) pair.step();
    ASSERT_TRUE(pair.touched && !pair.touching);
    error[halved] = pair.ledger.totals()[E::G_dt];
  }
  EXPECT_NEAR(error[0] / error[1], 4.0, 1.0);  // 4, but for where in a step the contact begins and ends
}

TEST(energy_ledger, state_goes_through_a_restart) {
  Pair pair;
  pair.evaluate(false);
  for (int n = 0; n < 100; n++) pair.step();
  EnergyLedger again;
  again.restore(pair.ledger.state(), pair.ledger.frame());
  EXPECT_EQ(again.totals(), pair.ledger.totals());
  EXPECT_EQ(again.start_energy(), pair.ledger.start_energy());
}

TEST(energy_ledger, one_step_of_a_spring_by_hand) {
  // k_t 100 -> 400, spring (0.01, 0, 0) -> tried (0.05, 0, 0), cut at (0.03, 0, 0):
  // D_t = (1 + 12)/2 0.02 = 0.13, G_k = -(400 - 100)/2 0.01 0.03 = -0.045.
  EnergyLedger ledger;
  ledger.set_law({1.5, true, false, false});
  const double rest[3] = {0.0, 0.0, 0.0};
  const LedgerFrame frame;
  ledger.begin_evaluation(2);
  Contact c = make_contact();
  ContactPast past;
  c.past = &past;
  c.tangential_stiffness = 100.0;
  c.spring = c.spring_before = Vector3d(0.0, 0.01, 0.0);
  c.cut.setZero();
  ledger.add(c, 0.1, false);
  ledger.begin_start_of_step(frame);
  for (int g = 0; g < 2; g++) ledger.start_of_step({g, 1.0, rest, rest, rest, rest}, rest, rest, 0.1);
  ledger.book_start(0.1);
  ledger.begin_evaluation(2);
  past = {true, 0.01, 6.0, 100.0, 0.0, 0.0};
  c.tangential_stiffness = 400.0;
  c.spring = Vector3d(0.0, 0.03, 0.0);
  c.cut = Vector3d(0.0, 0.02, 0.0);
  c.sliding = true;
  ledger.add(c, 0.1, true);
  ledger.begin_end_of_step();
  for (int g = 0; g < 2; g++) ledger.end_of_step({g, 1.0, rest, rest, rest, rest}, rest, rest, 0.1);
  ledger.book_step(0.1);
  EXPECT_NEAR(ledger.totals()[E::D_t], 0.13, 1e-15);
  EXPECT_NEAR(ledger.totals()[E::G_k], -0.045, 1e-15);
  EXPECT_NEAR(ledger.stored()[E::U_t], 0.5 * 400.0 * 9e-4, 1e-15);
  EXPECT_NEAR(ledger.stored()[E::U_n], 0.4 * 600.0 * 1e-4, 1e-15);
}

}

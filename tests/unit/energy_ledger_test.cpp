// SPDX-License-Identifier: GPL-2.0-or-later
#include "colliding_pair.h"
#include "make_contact.h"
#include <gtest/gtest.h>
#include <cmath>
#include <new>

namespace {

using namespace colliding_pair;
using E = EnergyLedger;

/** Rounding of a thousand sums of numbers below 3. */
const double rounding = 1e-13;

/** Work of the edges along x, y, z. */
Vector3d box_work(const EnergyLedger &ledger) {
  const auto totals = ledger.totals();
  return {totals[E::W_box_x], totals[E::W_box_y], totals[E::W_box_z]};
}

TEST(energy_ledger, a_collision_loses_what_the_ledger_says) {
  Pair pair;
  pair.evaluate(false);
  const double before = pair.kinetic();
  for (int n = 0; n < 400; n++) pair.step();
  ASSERT_TRUE(pair.touched && !pair.touching);
  const auto totals = pair.ledger.totals();
  double lost = 0.0;
  for (int k = E::D_n; k <= E::G_dt; k++) lost += totals[k];
  EXPECT_NEAR(lost, before - pair.kinetic(), rounding);
  EXPECT_NEAR(pair.residual(), 0.0, rounding);
  EXPECT_GT(totals[E::D_n], 0.05);
  EXPECT_GT(totals[E::D_t], 0.005);
  EXPECT_NE(totals[E::G_k], 0.0);
  EXPECT_EQ(totals[E::W_shear], 0.0);
}

/** The law takes another velocity than forces work with: without the latter nothing would close. What the turning of
 *  the spring makes, G_p, then falls with dt^2, and else with dt. */
TEST(energy_ledger, a_synchronized_collision_loses_what_the_ledger_says) {
  double gained[2][3];
  for (bool synchronized : {false, true})
    for (int fine = 0; fine < 3; fine++) {
      Pair pair(5e-4 / (1 << fine));
      pair.synchronized = synchronized;
      pair.evaluate(false);
      const double before = pair.kinetic();
      for (int n = 0; n < 800 << fine; n++) pair.step();
      ASSERT_TRUE(pair.touched && !pair.touching);
      const auto totals = pair.ledger.totals();
      double lost = 0.0;
      for (int k = E::D_n; k <= E::G_dt; k++) lost += totals[k];
      EXPECT_NEAR(lost, before - pair.kinetic(), 3.0 * rounding);
      EXPECT_NEAR(pair.residual(), 0.0, 3.0 * rounding);
      EXPECT_GT(totals[E::D_t], 0.005);
      gained[synchronized][fine] = totals[E::G_p];
    }
  for (int fine = 0; fine < 2; fine++) {
    EXPECT_NEAR(gained[false][fine] / gained[false][fine + 1], 2.0, 0.1);
    EXPECT_NEAR(gained[true][fine] / gained[true][fine + 1], 4.0, 0.4);
  }
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
  pair.frame.velocity_gradient << 0.1, 0.7, -0.2, 0.0, -0.3, 0.4, 0.0, 0.0, 0.2;
  pair.frame.edge_lengths << 8.0, 9.0, 10.0;
  pair.frame.edge_rates = pair.frame.velocity_gradient.diagonal().cwiseProduct(pair.frame.edge_lengths);
  pair.frame.centre << 0.3, -0.1, 0.2;
  pair.evaluate(false);
  for (int n = 0; n < 200; n++) pair.step();
  const auto totals = pair.ledger.totals();
  EXPECT_GT(std::fabs(totals[E::W_shear]) + std::fabs(totals[E::W_box]), 0.01);
  EXPECT_NEAR(pair.residual(), 0.0, rounding);
  EXPECT_EQ(totals[E::W_frame], 0.0);
  EXPECT_NEAR(box_work(pair.ledger).sum(), totals[E::W_box], rounding);
}

/** Two grains fly freely in a box whose edges have speeds of their own. Along each axis p = v - x speed/length, which
 *  changes as both x and the length do, and all of m p^2/2 along it is the work of these edges. */
TEST(energy_ledger, each_edge_works_on_the_motion_along_it) {
  Pair pair;
  const Vector3d first(8.0, 9.0, 10.0), speeds(0.8, -1.8, 3.0), places[2] = {{-3.0, 1.0, 2.0}, {2.0, -1.5, 0.5}};
  for (int g = 0; g < 2; g++) pair.spheres[g].x = places[g];
  pair.frame.edge_rates = speeds;
  pair.frame.edge_lengths = first;
  const auto set_gradient = [&pair, &speeds] {
    pair.frame.velocity_gradient.diagonal() = speeds.cwiseQuotient(pair.frame.edge_lengths);
  };
  set_gradient();
  pair.evaluate(false);
  const int steps = 300;
  for (int n = 0; n < steps; n++) {
    pair.frame.edge_lengths = first + n * pair.dt * speeds;
    set_gradient();
    pair.step();
  }
  ASSERT_FALSE(pair.touched);
  // The frame is that of the last step: the lengths where it began.
  const double end = steps * pair.dt;
  const Vector3d last = first + (end - pair.dt) * speeds;
  Vector3d expected = Vector3d::Zero();
  for (int g = 0; g < 2; g++) {
    const Sphere &s = pair.spheres[g];
    const Vector3d before = s.v - speeds.cwiseQuotient(first).cwiseProduct(places[g]),
                   after = s.v - speeds.cwiseQuotient(last).cwiseProduct(places[g] + end * s.v);
    expected += 0.5 * s.mass * (after.cwiseAbs2() - before.cwiseAbs2());
  }
  for (int a = 0; a < 3; a++) {
    EXPECT_GT(std::fabs(expected[a]), 0.01);
    EXPECT_NEAR(box_work(pair.ledger)[a], expected[a], rounding);
  }
  EXPECT_EQ(pair.ledger.totals()[E::W_frame], 0.0);
  EnergyLedger again;
  again.restore(pair.ledger.state(), pair.ledger.frame());
  EXPECT_EQ(box_work(again), box_work(pair.ledger));
}

/** Grains that touch, F = 9 (1, 2, 2)/3, held by forces from outside; L of the edges 0.1, -0.2, 0.4, of the shear 0.5.
 *  Contact, r = (2, 4, 4)/3: -dt L_aa F_a r_a = -(0.02, -0.16, 0.32), shear -dt 0.5 F_x r_y = -0.2.
 *  Motion: v = (1, 2, -1), L v = (1.1, -0.4, -0.4), p = (0.5, 2.2, -1), p - dt L v/2 = (0.445, 2.22, -0.98), m = 1:
 *  -dt L_aa v_a times that = (-0.00445, 0.0888, -0.0392), shear -dt 0.5 v_y 0.445 = -0.0445. So the mixed term
 *  m p_x L_xx L_xy y is in W_box_x, m p_x L_xy L_yy y in W_shear. */
TEST(energy_ledger, one_step_of_three_edges_by_hand) {
  EnergyLedger ledger;
  ledger.set_laws(make_law(1.0, grainscope::TangentialLaw::none));
  LedgerFrame frame;
  frame.velocity_gradient << 0.1, 0.5, 0.0, 0.0, -0.2, 0.0, 0.0, 0.0, 0.4;
  frame.edge_lengths << 10.0, 10.0, 10.0;
  frame.edge_rates << 1.0, -2.0, 4.0;
  const double rest[3] = {0.0, 0.0, 0.0}, v[3] = {1.0, 2.0, -1.0};
  double x[3] = {0.0, 1.0, 0.0};
  const double dt = 0.1;
  Contact c = make_contact();
  c.normal = Vector3d(1.0, 2.0, 2.0) / 3.0;
  c.branch = 2.0 * c.normal;
  c.motion->normal_damping = 3.0;
  c.force = 9.0 * c.normal;
  const auto start = [&] {
    ledger.begin_start_of_step(frame);
    ledger.start_of_step({0, 1.0, x, v, rest, rest}, rest, rest, dt);
    ledger.start_of_step({1, 2.0, rest, rest, rest, rest}, rest, rest, dt);
    ledger.book_start(dt);
  };
  ledger.begin_evaluation(2);
  ledger.add({&c, 1}, everyone(), dt, false);
  start();
  for (int a = 0; a < 3; a++) x[a] += dt * v[a];
  ledger.begin_evaluation(2);
  ledger.add({&c, 1}, everyone(), dt, true);
  ledger.begin_end_of_step();
  ledger.end_of_step({0, 1.0, x, v, rest, rest}, rest, rest, dt);
  ledger.end_of_step({1, 2.0, rest, rest, rest, rest}, rest, rest, dt);
  ledger.book_step(dt);
  const Vector3d work = box_work(ledger), expected(-0.02445, 0.2488, -0.3592);
  for (int a = 0; a < 3; a++) EXPECT_NEAR(work[a], expected[a], 1e-15);
  EXPECT_NEAR(ledger.totals()[E::W_box], expected.sum(), 1e-15);
  EXPECT_NEAR(ledger.totals()[E::W_shear], -0.2445, 1e-15);

  // The lengths move on, at x = (0.1, 1.2, -0.1); what also changes the shear is W_frame.
  frame.edge_lengths << 10.1, 9.8, 10.4;
  frame.velocity_gradient.diagonal() = frame.edge_rates.cwiseQuotient(frame.edge_lengths);
  const Vector3d at(0.1, 1.2, -0.1), before = Vector3d(1.0 - 0.01 - 0.6, 2.0 + 0.24, -1.0 + 0.04),
                                     after = Vector3d(1.0 - 0.1 / 10.1 - 0.6, 2.0 + 2.4 / 9.8, -1.0 + 0.4 / 10.4);
  frame.velocity_gradient(0, 1) = 0.6;
  start();
  for (int a = 0; a < 3; a++)
    EXPECT_NEAR(box_work(ledger)[a] - work[a], 0.5 * (after[a] * after[a] - before[a] * before[a]), 1e-14);
  const double other = after[0] - 0.1 * at[1];
  EXPECT_NEAR(ledger.totals()[E::W_frame], 0.5 * (other * other - after[0] * after[0]), 1e-14);
}

TEST(energy_ledger, a_changed_frame_is_told_apart_from_a_box_that_moves_on) {
  Pair pair;
  pair.frame.edge_lengths << 10.0, 10.0, 10.0;
  pair.frame.velocity_gradient(1, 1) = 0.1;
  pair.frame.edge_rates[1] = 1.0;
  pair.evaluate(false);
  pair.step();
  pair.frame.edge_lengths[1] += pair.dt;  // the same velocity of the edge, a longer box: a smaller gradient
  pair.frame.velocity_gradient(1, 1) = 1.0 / pair.frame.edge_lengths[1];
  pair.step();
  EXPECT_EQ(pair.ledger.totals()[E::W_frame], 0.0);
  double expected = 0.0;
  for (const Sphere &s : pair.spheres) {
    const double y = s.x[1], p = s.v[1] - pair.frame.velocity_gradient(1, 1) * y, q = s.v[1] - 0.2 * y;
    expected += 0.5 * s.mass * (q * q - p * p);
  }
  pair.frame.velocity_gradient(1, 1) = 0.2;
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
  ledger.set_laws(make_law(1.5, grainscope::TangentialLaw::spring));
  const double rest[3] = {0.0, 0.0, 0.0};
  const LedgerFrame frame;
  ledger.begin_evaluation(2);
  Contact c = make_contact();
  const Vector3d before(0.0, 0.01, 0.0), after(0.0, 0.03, 0.0), cut(0.0, 0.02, 0.0);
  c.motion->tangential_stiffness = 100.0;
  c.spring = ContactSpring{before, before, Vector3d::Zero()};
  ledger.add({&c, 1}, everyone(), 0.1, false);
  ledger.begin_start_of_step(frame);
  for (int g = 0; g < 2; g++) ledger.start_of_step({g, 1.0, rest, rest, rest, rest}, rest, rest, 0.1);
  ledger.book_start(0.1);
  ledger.begin_evaluation(2);
  c.past = ContactPast{0.01, 6.0, 100.0, 0.0, 0.0};
  c.motion->tangential_stiffness = 400.0;
  c.spring = ContactSpring{before, after, cut};
  c.sliding = true;
  ledger.add({&c, 1}, everyone(), 0.1, true);
  ledger.begin_end_of_step();
  for (int g = 0; g < 2; g++) ledger.end_of_step({g, 1.0, rest, rest, rest, rest}, rest, rest, 0.1);
  ledger.book_step(0.1);
  EXPECT_NEAR(ledger.totals()[E::D_t], 0.13, 1e-15);
  EXPECT_NEAR(ledger.totals()[E::G_k], -0.045, 1e-15);
  EXPECT_NEAR(ledger.stored()[E::U_t], 0.5 * 400.0 * 9e-4, 1e-15);
  EXPECT_NEAR(ledger.stored()[E::U_n], 0.4 * 600.0 * 1e-4, 1e-15);
}

/** Nothing of a ledger is at multiples of more than 8 bytes, unless by chance. */
TEST(energy_ledger, closes_wherever_it_is_in_memory) {
  alignas(64) static char memory[sizeof(Pair) + 64];
  for (int offset = 0; offset < 64; offset += 8) {
    Pair *pair = new (memory + offset) Pair;
    pair->spheres[0].x[0] = -0.99;
    pair->evaluate(false);
    for (int n = 0; n < 5; n++) pair->step();
    EXPECT_TRUE(pair->touching);
    EXPECT_NEAR(pair->residual(), 0.0, rounding);
    pair->~Pair();
  }
}

TEST(energy_ledger, rolling_loses_what_the_ledger_says) {
  Pair pair;
  pair.ledger.set_laws(make_law(1.5, grainscope::TangentialLaw::spring, true));
  pair.rolling = 0.5;
  pair.evaluate(false);
  for (int n = 0; n < 400; n++) pair.step();
  EXPECT_GT(pair.ledger.totals()[E::D_rolling], 1e-3);
  EXPECT_NEAR(pair.residual(), 0.0, rounding);
}

}

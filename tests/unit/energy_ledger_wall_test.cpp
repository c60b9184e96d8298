// SPDX-License-Identifier: GPL-2.0-or-later
#include "colliding_pair.h"
#include <gtest/gtest.h>
#include <cmath>

namespace {

using namespace colliding_pair;
using E = EnergyLedger;

/** Rounding of a thousand sums of numbers below 3. */
const double rounding = 1e-13;

/** A sphere on a plane that moves as it likes, under a law of this test's own, with a weight. */
struct Ball {
  static constexpr double k = 1e4, c = 30.0, h = 8e3, friction = 0.3;
  const double dt = 1e-3;
  Sphere sphere{2.0, 0.8, {0.1, 0.2, 1.005}, {0.3, -0.2, -0.4}, {0.2, 0.3, -0.1}};
  Vector3d weight = Vector3d(0.0, 0.0, -4.0);
  Vector3d wall = Vector3d::Zero(), plane = Vector3d::Zero();  // velocity and place
  int triangle = 3;
  LedgerFrame frame;
  EnergyLedger ledger;
  grainscope::ContactLaw law = make_law(1.5, grainscope::TangentialLaw::spring);
  bool touching = false;
  Vector3d pushed = Vector3d::Zero();  // by the wall

  Ball() { set_laws(); }
  void set_laws() { ledger.set_laws(make_law(1.0, grainscope::TangentialLaw::none), {&law}); }

  void evaluate(bool springs_move) {
    Sphere &s = sphere;
    s.force = weight;
    s.torque = pushed = Vector3d::Zero();
    ledger.begin_evaluation(1);
    const double d = 1.0 - (s.x[2] - plane[2]);
    touching = d > 0.0;
    if (!touching) {
      past_.reset();
      spring_.setZero();
      return;
    }
    Contact contact;
    ContactMotion &motion = contact.motion.emplace();
    contact.i = 0;
    contact.law = &law;
    contact.partner = grainscope::PartnerWall{0, triangle, wall};
    contact.normal = Vector3d::UnitZ();
    contact.overlap = d;
    motion.arm = -(1.0 - 0.5 * d) * contact.normal;
    motion.point = s.x + motion.arm;
    contact.branch = -motion.arm;
    const Vector3d u = s.v + s.omega.cross(motion.arm) - wall;
    motion.normal_velocity = u[2];
    motion.tangential_velocity = Vector3d(u[0], u[1], 0.0);
    motion.normal_stiffness = k * std::pow(d, law.exponent - 1.0);
    motion.normal_damping = -c * std::sqrt(std::sqrt(d)) * u[2];
    contact.normal_force = motion.normal_stiffness * d + motion.normal_damping;
    if (law.tangential == grainscope::TangentialLaw::spring) {
      motion.tangential_stiffness = h * std::sqrt(d);
      const Vector3d before = spring_, tried = spring_ + (springs_move ? dt : 0.0) * motion.tangential_velocity;
      const double limit = friction * std::fabs(contact.normal_force) / motion.tangential_stiffness;
      contact.sliding = tried.norm() > limit;
      spring_ = contact.sliding ? Vector3d(limit / tried.norm() * tried) : tried;
      contact.spring = ContactSpring{before, spring_, tried - spring_};
      contact.tangential_force = -motion.tangential_stiffness * spring_;
    } else {
      contact.tangential_force = -5.0 * motion.tangential_velocity;
    }
    contact.force = pushed = contact.normal_force * contact.normal + contact.tangential_force;
    contact.past = past_;
    ledger.add({&contact, 1}, everyone(), dt, springs_move);
    past_ = ContactPast{d, motion.normal_stiffness * d, motion.tangential_stiffness,
                        -0.5 * dt * motion.normal_stiffness * d * u[2],
                        0.5 * dt * motion.tangential_stiffness * spring_.dot(motion.tangential_velocity)};
    s.force += contact.force;
    s.torque = motion.arm.cross(contact.force);
  }

  void start() {
    const Vector3d momentum = sphere.inertia * sphere.omega,
                   after = sphere.omega + 0.5 * dt / sphere.inertia * sphere.torque;
    ledger.begin_start_of_step(frame);
    ledger.start_of_step(sphere.shown(0), after.data(), momentum.data(), dt);
    ledger.start_with_weight(sphere.shown(0), weight, dt);
    ledger.book_start(dt);
    sphere.kick(dt);
    sphere.x += dt * sphere.v;
  }
  void end() {
    const Vector3d momentum = sphere.inertia * sphere.omega;
    ledger.begin_end_of_step();
    ledger.end_of_step(sphere.shown(0), sphere.omega.data(), momentum.data(), dt);
    ledger.end_with_weight(sphere.shown(0), weight);
    ledger.book_step(dt);
    sphere.kick(dt);
  }
  /** The wall moves first, with the velocity of the whole step. */
  void step(const Vector3d &velocity) {
    start();
    wall = velocity;
    plane += dt * wall;
    evaluate(true);
    end();
  }

  double residual() const { return E::residual(ledger.totals(), E::energy(ledger.stored()) - ledger.start_energy()); }

 private:
  Vector3d spring_ = Vector3d::Zero();
  std::optional<ContactPast> past_;
};

Vector3d swinging(int n) { return {0.2 * std::cos(0.1 * n), -0.1, 0.3 * std::sin(0.05 * n)}; }

TEST(energy_ledger_wall, a_wall_that_stands_takes_and_gives_nothing) {
  Ball ball;
  ball.weight.setZero();
  ball.sphere.v = Vector3d(1.5, -0.2, -0.4);  // it slides
  ball.evaluate(false);
  const double before = 0.5 * ball.sphere.mass * ball.sphere.v.squaredNorm() +
                        0.5 * ball.sphere.inertia * ball.sphere.omega.squaredNorm();
  bool touched = false;
  for (int n = 0; n < 400; n++) {
    ball.step(Vector3d::Zero());
    touched = touched || ball.touching;
  }
  ASSERT_TRUE(touched && !ball.touching);
  const auto totals = ball.ledger.totals();
  const double after = 0.5 * ball.sphere.mass * ball.sphere.v.squaredNorm() +
                       0.5 * ball.sphere.inertia * ball.sphere.omega.squaredNorm();
  double lost = totals[E::G_w];
  for (int k = E::D_n_w; k <= E::D_rolling_w; k++) lost += totals[k];
  EXPECT_NEAR(lost, before - after, rounding);
  EXPECT_EQ(totals[E::D_n_w], totals[E::D_n]);
  EXPECT_EQ(totals[E::D_t_w], totals[E::D_t]);
  EXPECT_GT(totals[E::D_n_w], 0.05);
  EXPECT_GT(totals[E::D_t_w], 0.005);
  EXPECT_EQ(totals[E::W_wall], 0.0);
  EXPECT_NEAR(ball.residual(), 0.0, rounding);
}

TEST(energy_ledger_wall, work_is_force_times_path_of_the_wall) {
  Ball ball;
  ball.evaluate(false);
  double work = 0.0, weight = 0.0;
  for (int n = 0; n < 600; n++) {
    const Vector3d before = ball.pushed, was = ball.wall, at = ball.sphere.x;
    ball.step(swinging(n));
    // A contact that has opened ends with the velocity that it had.
    work += 0.5 * ball.dt * (before.dot(ball.touching ? ball.wall : was) + ball.pushed.dot(ball.wall));
    weight += ball.weight.dot(ball.sphere.x - at);
  }
  const auto totals = ball.ledger.totals();
  EXPECT_GT(std::fabs(work), 0.1);
  EXPECT_NEAR(totals[E::W_wall], work, rounding);
  EXPECT_NEAR(totals[E::W_gravity], weight, rounding);
  EXPECT_NEAR(totals[E::W_other], 0.0, rounding);
  EXPECT_NEAR(ball.residual(), 0.0, rounding);
}

/** A plane that moves along its normal changes the overlap by what its velocity says: nothing is left for G_n. */
TEST(energy_ledger_wall, both_forces_of_a_step_see_the_velocity_of_that_step) {
  Ball ball;
  ball.sphere.omega.setZero();
  ball.sphere.v = Vector3d(0.0, 0.0, -0.1);
  ball.sphere.x[2] = 0.99;
  ball.evaluate(false);
  for (int n = 0; n < 20; n++) {
    ball.triangle = n % 2;  // from one triangle of the plane to the next
    ball.step(Vector3d(0.0, 0.0, 0.02 * n));
    ASSERT_TRUE(ball.touching);
  }
  EXPECT_NEAR(ball.ledger.totals()[E::G_n], 0.0, rounding);
  EXPECT_GT(std::fabs(ball.ledger.totals()[E::W_wall]), 0.01);
}

TEST(energy_ledger_wall, closes_in_a_flow_where_the_wall_moves_against_it) {
  Ball ball;
  ball.frame.velocity_gradient << 0.1, 0.7, -0.2, 0.0, -0.3, 0.4, 0.0, 0.0, 0.2;
  ball.frame.edge_lengths << 8.0, 9.0, 10.0;
  ball.frame.edge_rates = ball.frame.velocity_gradient.diagonal().cwiseProduct(ball.frame.edge_lengths);
  ball.frame.centre << 0.3, -0.1, 0.2;
  ball.evaluate(false);
  for (int n = 0; n < 600; n++) ball.step(swinging(n));
  EXPECT_NEAR(ball.residual(), 0.0, rounding);
  const auto totals = ball.ledger.totals();
  EXPECT_NEAR(totals[E::W_other], 0.0, rounding);
  EXPECT_NEAR(totals[E::W_box_x] + totals[E::W_box_y] + totals[E::W_box_z], totals[E::W_box], rounding);
}

/** The floor's branch stands along z: edges along z work on it, F_z from the contact point to the centre; those along x
 *  and y on the flight alone. */
TEST(energy_ledger_wall, edges_work_on_contacts_with_walls_along_their_axis) {
  Ball ball;
  const Vector3d rates(0.1, -0.3, 0.2);
  ball.frame.velocity_gradient.diagonal() = ball.frame.edge_rates = rates;  // of edges of length 1, kept
  ball.sphere.x[2] = 0.99;
  ball.sphere.v[2] = -0.1;
  ball.evaluate(false);
  Vector3d work = Vector3d::Zero();
  const auto add_contact = [&] {
    work[2] -= 0.5 * ball.dt * rates[2] * ball.pushed[2] * 0.5 * (1.0 + ball.sphere.x[2] - ball.plane[2]);
  };
  for (int n = 0; n < 20; n++) {
    add_contact();
    const Vector3d at = ball.sphere.x, v = ball.sphere.v + 0.5 * ball.dt / ball.sphere.mass * ball.sphere.force,
                   drift = ball.dt * rates.cwiseProduct(v);
    work -= ball.sphere.mass * drift.cwiseProduct(v - rates.cwiseProduct(at) - 0.5 * drift);
    ball.step(Vector3d::Zero());
    ASSERT_TRUE(ball.touching);
    add_contact();
  }
  for (int a = 0; a < 3; a++) EXPECT_NEAR(ball.ledger.totals()[E::W_box_x + a], work[a], rounding);
  EXPECT_NEAR(ball.ledger.totals()[E::W_box], work.sum(), rounding);
}

/** A wall that moves with the flow does no work against it, at the point where it is touched. */
TEST(energy_ledger_wall, a_wall_in_the_flow_does_no_work) {
  Ball ball;
  ball.sphere = {2.0, 0.8, {0.1, 0.2, 0.99}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  ball.frame.velocity_gradient(0, 1) = 0.7;
  ball.frame.centre << 0.3, -0.1, 0.0;
  ball.wall = Vector3d(0.7 * 0.3, 0.0, 0.0);
  ball.evaluate(false);
  ball.step(ball.wall);
  EXPECT_NEAR(ball.ledger.totals()[E::W_wall], 0.0, 1e-7);  // the grain has moved on a little in y
  EXPECT_GT(E::energy(ball.ledger.stored()), 0.0);
}

TEST(energy_ledger_wall, goes_by_the_law_of_the_wall) {
  Ball ball;
  ball.law = make_law(1.0, grainscope::TangentialLaw::viscous);  // Hooke, friction without a spring
  ball.set_laws();
  ball.sphere.x[2] = 0.99;
  ball.evaluate(false);
  for (int n = 0; n < 5; n++) ball.step(Vector3d::Zero());
  ASSERT_TRUE(ball.touching);
  const double overlap = 1.0 - (ball.sphere.x[2] - ball.plane[2]);
  EXPECT_NEAR(ball.ledger.stored()[E::U_n_w], 0.5 * Ball::k * overlap * overlap, 1e-13);
  EXPECT_NEAR(ball.ledger.totals()[E::G_dt], 0.0, rounding);  // the trapezium rule is exact
  EXPECT_GT(ball.ledger.totals()[E::D_t_w], 0.0);
  EXPECT_EQ(ball.ledger.totals()[E::G_p], 0.0);
  EXPECT_NEAR(ball.residual(), 0.0, rounding);
}

TEST(energy_ledger_wall, a_grain_that_leaves_takes_its_energy_along) {
  Ball ball;
  ball.sphere.x[2] = 0.98;
  ball.evaluate(false);
  for (int n = 0; n < 10; n++) ball.step(swinging(n));
  ASSERT_TRUE(ball.touching);
  const auto before = ball.ledger.totals();
  const double stored = ball.ledger.stored()[E::U_n] + ball.ledger.stored()[E::U_t];
  ball.start();
  const Vector3d momentum = ball.sphere.inertia * ball.sphere.omega;
  E::Passage out, in;
  out.kinetic = ball.ledger.kinetic_in_step(ball.sphere.shown(0), ball.sphere.omega.data(), momentum.data());
  out.normal[E::walls] = ball.ledger.stored()[E::U_n];
  out.spring[E::walls] = ball.ledger.stored()[E::U_t];
  ball.ledger.begin_evaluation(0);
  ball.ledger.pass_in_step(out, in);
  ball.ledger.begin_end_of_step();
  ball.ledger.book_step(ball.dt);
  const auto after = ball.ledger.totals();
  EXPECT_NEAR(after[E::W_out], out.kinetic + stored, rounding);
  EXPECT_EQ(E::energy(ball.ledger.stored()), 0.0);
  EXPECT_NEAR(ball.residual(), 0.0, rounding);
  EXPECT_NEAR(after[E::G_w], before[E::G_w], 0.1 * stored);  // half a step of a collision of 20
}

TEST(energy_ledger_wall, a_grain_that_comes_brings_its_energy) {
  Ball ball;
  ball.ledger.begin_evaluation(0);
  ball.ledger.begin_start_of_step(ball.frame);
  ball.ledger.book_start(ball.dt);
  ball.wall = Vector3d(0.1, 0.0, 0.2);
  ball.evaluate(true);
  const Vector3d momentum = ball.sphere.inertia * ball.sphere.omega;
  E::Passage out, in;
  in.kinetic = ball.ledger.kinetic_in_step(ball.sphere.shown(0), ball.sphere.omega.data(), momentum.data());
  ball.ledger.pass_in_step(out, in);
  ball.end();
  for (int n = 0; n < 100; n++) ball.step(swinging(n));
  EXPECT_GT(in.kinetic, 0.1);
  EXPECT_EQ(ball.ledger.totals()[E::W_in], in.kinetic);
  EXPECT_NEAR(ball.residual(), 0.0, rounding);
}

TEST(energy_ledger_wall, what_passes_between_steps_is_no_work_from_outside) {
  Ball ball;
  ball.evaluate(false);
  for (int n = 0; n < 10; n++) ball.step(swinging(n));
  E::Passage out, in;
  out.kinetic = 0.5;
  in.kinetic = 0.25;
  in.spring[E::grains] = 0.125;
  const auto before = ball.ledger.totals();
  ball.ledger.pass_between_steps(out, in);
  const auto after = ball.ledger.totals();
  EXPECT_EQ(after[E::W_out] - before[E::W_out], 0.5);
  EXPECT_EQ(after[E::W_in] - before[E::W_in], 0.375);
  EXPECT_NEAR(after[E::W_other] - before[E::W_other], 0.125, rounding);
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "spheroid_rotation.h"
#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <functional>

using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

using Torque = std::function<Vector3d(const Quaterniond &)>;

/** Spheroid 1, 1, alpha of mass 5 whose symmetry axis is body axis k. */
Vector3d inertia_of(double alpha, int k) {
  Vector3d inertia = Vector3d::Constant(1.0 + alpha * alpha);
  inertia[k] = 2.0;
  return inertia;
}

struct Body {
  Vector3d inertia;
  Quaterniond q;
  Vector3d momentum;
  Vector3d omega = Vector3d::Zero();
  double wxyz[4] = {q.w(), q.x(), q.y(), q.z()};

  void drift(double dt) {
    grainscope::rotate_freely(inertia.data(), momentum.data(), dt, wxyz, omega.data());
    q = Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  }
  void step(double dt, const Torque &torque) {
    momentum += 0.5 * dt * torque(q);
    drift(dt);
    momentum += 0.5 * dt * torque(q);
  }
  Vector3d angular_velocity() const {
    Vector3d w;
    grainscope::angular_velocity(inertia.data(), momentum.data(), wxyz, w.data());
    return w;
  }
  double energy() const { return 0.5 * momentum.dot(angular_velocity()); }
};

/** Axis k along `u`, turned about it by 0.7; angular velocity of length `spin`, at `angle` from u. */
Body spinning(double alpha, int k, double angle, double spin, Vector3d u = Vector3d(0.3, -0.5, 0.7)) {
  const Vector3d e = Vector3d::Unit(k), half_way = (e + u.normalized()).normalized();
  const Quaterniond aim(Eigen::AngleAxisd(M_PI, half_way));
  Body body{inertia_of(alpha, k), aim * Eigen::AngleAxisd(0.7, e), {}};
  Vector3d w;
  w[k] = std::cos(angle);
  w[(k + 1) % 3] = 0.6 * std::sin(angle);
  w[(k + 2) % 3] = 0.8 * std::sin(angle);
  body.momentum = body.q * Vector3d(spin * w.cwiseProduct(body.inertia));
  return body;
}

/** Angle between two orientations. */
double between(const Quaterniond &a, const Quaterniond &b) { return 2.0 * (a.conjugate() * b).vec().norm(); }

/** Euler's equations dq/dt = q (0, w)/2, w = R^T L / I, in long double by fourth-order steps: knows nothing of
 *  symmetric tops. */
Quaterniond integrated(const Body &body, double time, int steps) {
  using Q = Eigen::Quaternion<long double>;
  using V = Eigen::Matrix<long double, 3, 1>;
  const V momentum = body.momentum.cast<long double>(), inertia = body.inertia.cast<long double>();
  const auto rate = [&](const Q &q) {
    const V w = (q.normalized().conjugate() * momentum).cwiseQuotient(inertia);
    return Eigen::Matrix<long double, 4, 1>(0.5L * (q * Q(0.0L, w[0], w[1], w[2])).coeffs());
  };
  const auto moved = [](const Q &q, const Eigen::Matrix<long double, 4, 1> &d) { return Q(q.coeffs() + d); };
  Q q = body.q.cast<long double>();
  const long double h = static_cast<long double>(time) / steps;
  for (int n = 0; n < steps; n++) {
    const auto a = rate(q), b = rate(moved(q, a * (h / 2))), c = rate(moved(q, b * (h / 2))), d = rate(moved(q, c * h));
    q = moved(q, (a + 2.0L * b + 2.0L * c + d) * (h / 6));
  }
  return q.normalized().cast<double>();
}

const double alphas[] = {0.33, 1.5, 3.0};
const double angles[] = {0.0, M_PI_4, M_PI_2, 2.5};

}

TEST(spheroid_rotation, tangent_is_that_of_the_library_on_both_sides_of_the_switch) {
  for (double h : {1e-12, 1e-6, 1e-3, 0.01, 0.0316, 0.0317, 0.05, 0.06, 0.1, 1.0, 1.5, 2.0, 3.0})
    EXPECT_NEAR(grainscope::tan_over_angle(h * h) / static_cast<double>(std::tan(static_cast<long double>(h)) / h), 1.0,
                1e-15)
        << h;
  EXPECT_EQ(grainscope::tan_over_angle(0.0), 1.0);
}

TEST(spheroid_rotation, angular_velocity_is_that_of_the_inertia_tensor) {
  for (double alpha : alphas)
    for (int k = 0; k < 3; k++)
      for (double angle : angles) {
        const Body body = spinning(alpha, k, angle, 1.0);
        const Vector3d expected = body.q * Vector3d((body.q.conjugate() * body.momentum).cwiseQuotient(body.inertia));
        EXPECT_LT((body.angular_velocity() - expected).norm(), 3e-15);
      }
}

TEST(spheroid_rotation, solves_eulers_equations) {
  for (double alpha : alphas)
    for (int k = 0; k < 3; k++)
      for (double angle : angles)
        for (double time : {0.01, 5.0}) {  // by the series, and by the library
          Body body = spinning(alpha, k, angle, 1.0);
          const Quaterniond expected = integrated(body, time, time < 1.0 ? 100 : 20000);
          body.drift(time);
          EXPECT_LT(between(body.q, expected), 2e-14) << alpha << " " << k << " " << angle << " " << time;
          EXPECT_LT((body.omega - body.angular_velocity()).norm(), 1e-16);
        }
}

TEST(spheroid_rotation, many_small_steps_are_one_large_one) {
  for (double alpha : alphas) {
    Body body = spinning(alpha, 2, 1.0, 1.0), once = body;
    for (int n = 0; n < 1000; n++) body.drift(0.02);
    once.drift(20.0);
    EXPECT_LT(between(body.q, once.q), 1e-12);
  }
}

TEST(spheroid_rotation, equal_moments_turn_about_their_spin) {
  const Vector3d axis = Vector3d(1, 2, -2) / 3.0;
  for (double turn : {0.01, 3.0, M_PI}) {
    Body body{Vector3d::Constant(0.4), Quaterniond(0.5, 0.5, -0.5, 0.5), 0.4 * axis};
    const Quaterniond expected = Eigen::AngleAxisd(turn, axis) * body.q;
    body.drift(turn);
    EXPECT_LT(between(body.q, expected), 1e-15);
    EXPECT_LT((body.omega - axis).norm(), 1e-15);
  }
}

TEST(spheroid_rotation, a_grain_at_rest_stays) {
  Body body = spinning(1.5, 2, 0.0, 0.0);
  const Quaterniond before = body.q;
  body.drift(1.0);
  EXPECT_LT(between(body.q, before), 1e-15);
  EXPECT_TRUE(body.omega.isZero(0.0));
}

/** The momentum is not touched at all. Rounding of the orientation moves L.u, and the energy with it, by a random walk
 *  of 1e-16 sqrt(steps); the phase, 10^4 rad, is off by as much, relative. */
TEST(spheroid_rotation, a_million_free_steps_keep_energy_and_phase) {
  const int steps = 1000000;
  for (double alpha : alphas)
    for (double angle : {0.0, M_PI_4, M_PI_2}) {
      Body body = spinning(alpha, 2, angle, 1.0);
      const double dt = 0.01, energy = body.energy();
      Body once = body;
      double drift = 0.0;
      for (int n = 0; n < steps; n++) {
        body.drift(dt);
        if (n % 1000 == 0) drift = std::max(drift, std::fabs(body.energy() / energy - 1.0));
      }
      once.drift(steps * dt);
      EXPECT_LT(drift, 5e-13) << alpha << " " << angle;
      EXPECT_LT(std::fabs(body.q.norm() - 1.0), 5e-16);
      EXPECT_LT(between(body.q, once.q), 1e-8) << alpha << " " << angle;
    }
}

/** A spheroid that hangs by its axis from a torque K u x (-z) and swings in a plane: theta'' = -(K/I_e) sin theta, of
 *  period 4 K(sin(theta_0/2)) sqrt(I_e/K), after which it is where it began. */
TEST(spheroid_rotation, a_pendulum_returns_after_its_period_to_second_order) {
  const double theta = 2.0, strength = 3.0;
  const Torque torque = [&](const Quaterniond &q) {
    return Vector3d(strength * (q * Vector3d::UnitZ()).cross(-Vector3d::UnitZ()));
  };
  for (double alpha : alphas) {
    Body start = spinning(alpha, 2, 0.0, 0.0, Vector3d(std::sin(theta), 0.0, -std::cos(theta)));
    start.momentum.setZero();
    const double period = 4.0 * std::comp_ellint_1(std::sin(0.5 * theta)) * std::sqrt(start.inertia[0] / strength);
    double error[3];
    for (int n = 0; n < 3; n++) {
      const int steps = 200 << n;
      Body body = start;
      for (int s = 0; s < steps; s++) body.step(period / steps, torque);
      error[n] = std::hypot(between(body.q, start.q), body.angular_velocity().norm());
    }
    EXPECT_NEAR(std::log2(error[0] / error[1]), 2.0, 0.05);
    EXPECT_NEAR(std::log2(error[1] / error[2]), 2.0, 0.05);
    EXPECT_LT(error[2], 2e-3);
  }
}

/** A heavy top, torque K u x z. Its steady precession at tilt theta turns u about z at the rate p, where
 *  I_e cos(theta) p^2 - L_u p - K = 0 (K pulls toward z). */
TEST(spheroid_rotation, a_top_precesses_steadily_to_second_order) {
  const double theta = 0.8, strength = 0.5, rate = 1.3, time = 6.0;
  const Torque torque = [&](const Quaterniond &q) {
    return Vector3d(strength * (q * Vector3d::UnitX()).cross(Vector3d::UnitZ()));
  };
  for (double alpha : alphas) {
    Body start = spinning(alpha, 0, 0.0, 0.0, Vector3d(std::sin(theta), 0.0, std::cos(theta)));
    const Vector3d u = start.q * Vector3d::UnitX();
    const double across = start.inertia[1], along = across * std::cos(theta) * rate - strength / rate;
    start.momentum = along * u + across * rate * (Vector3d::UnitZ() - std::cos(theta) * u);
    const Vector3d expected = Eigen::AngleAxisd(rate * time, Vector3d::UnitZ()) * u;
    double error[2];
    for (int n = 0; n < 2; n++) {
      const int steps = 400 << n;
      Body body = start;
      for (int s = 0; s < steps; s++) body.step(time / steps, torque);
      error[n] = (body.q * Vector3d::UnitX() - expected).norm();
      EXPECT_NEAR(body.momentum.dot(body.q * Vector3d::UnitX()), along, 1e-13);  // neither kick nor drift touches them
      EXPECT_NEAR(body.momentum.z(), start.momentum.z(), 1e-13);
    }
    EXPECT_NEAR(std::log2(error[0] / error[1]), 2.0, 0.05);
    EXPECT_LT(error[1], 1e-3);
  }
}

TEST(spheroid_rotation, goes_back_the_way_it_came) {
  const Torque torque = [](const Quaterniond &q) {
    return Vector3d((q * Vector3d::UnitZ()).cross(Vector3d(0.3, 0.2, 1.0)));
  };
  Body body = spinning(1.5, 2, 1.0, 1.0);
  const Body start = body;
  for (int s = 0; s < 1000; s++) body.step(0.02, torque);
  EXPECT_GT(between(body.q, start.q), 0.1);
  body.momentum *= -1.0;
  for (int s = 0; s < 1000; s++) body.step(0.02, torque);
  EXPECT_LT(between(body.q, start.q), 1e-11);
  EXPECT_LT((body.momentum + start.momentum).norm(), 1e-11);
}

TEST(spheroid_rotation, mends_a_quaternion_that_is_not_normalised) {
  Body body = spinning(1.5, 2, 1.0, 1.0);
  for (double &c : body.wxyz) c *= 1.0 + 1e-6;
  body.drift(0.01);
  EXPECT_NEAR(body.q.norm(), 1.0, 1e-15);
}

TEST(symmetric_top, is_found_by_its_moments) {
  const double about_z[3] = {2.0, 2.0, 1.0}, about_x[3] = {1.0, 2.0, 2.0}, about_y[3] = {2.0, 3.0, 2.0},
               ball[3] = {1.0, 1.0, 1.0};
  const double rounded[3] = {2.0, 2.0 * (1 + 2e-9), 1.0}, unlike[3] = {2.0, 2.0 * (1 + 2e-8), 1.0};
  EXPECT_EQ(grainscope::axis_of_symmetric_top(about_z), 2);
  EXPECT_EQ(grainscope::axis_of_symmetric_top(about_x), 0);
  EXPECT_EQ(grainscope::axis_of_symmetric_top(about_y), 1);
  EXPECT_EQ(grainscope::axis_of_symmetric_top(rounded), 2);
  for (const double *inertia : {about_z, about_x, about_y, ball, rounded})
    EXPECT_TRUE(grainscope::is_symmetric_top(inertia));
  EXPECT_FALSE(grainscope::is_symmetric_top(unlike));
}

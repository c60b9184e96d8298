// SPDX-License-Identifier: GPL-2.0-or-later
#include "make_contact.h"
#include "pressure_control.h"
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>
#include <random>

using grainscope::ContactLaw;
using grainscope::Intervals;
using grainscope::NetworkResponse;
using grainscope::PressureControl;
using grainscope::TangentialLaw;

namespace {

const ContactLaw hertz = make_law(1.5, TangentialLaw::spring), frictionless_hertz = make_law(1.5, TangentialLaw::none);

/** K_ab and eta_ab of a network as full matrices. */
Eigen::MatrixXd matrix_of(const std::array<double, 21> &triangle, const std::vector<int> &modes) {
  Eigen::MatrixXd full(modes.size(), modes.size());
  for (std::size_t a = 0; a < modes.size(); a++)
    for (std::size_t b = 0; b < modes.size(); b++) full(a, b) = triangle[NetworkResponse::place(modes[a], modes[b])];
  return full;
}

/** Contacts in random directions, of spheres or not, sticking and damped or not. */
NetworkResponse random_network(std::mt19937 &random, int contacts, const std::vector<int> &modes) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  static const ContactLaw sticking = make_law(1.0, TangentialLaw::spring);
  NetworkResponse network;
  for (int n = 0; n < contacts; n++) {
    grainscope::Contact c = by(make_contact(), sticking);
    for (int k = 0; k < 3; k++) c.normal[k] = normal(random);
    c.normal.normalize();
    c.branch = 2.0 * c.normal;
    if (uniform(random) < 0.5)
      for (int k = 0; k < 3; k++) c.branch[k] += 0.5 * normal(random);
    c.motion->normal_stiffness = std::exp(normal(random));
    c.motion->tangential_stiffness = 0.82 * uniform(random) * c.motion->normal_stiffness;
    c.motion->damping_coefficient = uniform(random) < 0.3 ? 0.0 : std::exp(3.0 * normal(random));
    c.motion->damped = uniform(random) < 0.5;
    c.motion->tangential_damping = c.motion->damping_coefficient;
    network.add(c, modes);
  }
  return network;
}

}

TEST(network_response, one_contact_by_hand) {
  NetworkResponse along, across, frictionless;
  const std::vector<int> x{0}, y{1};
  along.add(by(make_contact(), hertz), x);
  const int xx = NetworkResponse::place(0, 0), yy = NetworkResponse::place(1, 1);
  EXPECT_DOUBLE_EQ(along.pressure[0], 20.0);                 // F_x r_x
  EXPECT_DOUBLE_EQ(along.stiffness[xx], 1.5 * 600.0 * 4.0);  // the tangent of Hertz, n_x = 1
  EXPECT_DOUBLE_EQ(along.damping[xx], 8.0 * 4.0);
  grainscope::Contact c = make_contact();
  c.branch = Eigen::Vector3d(0.0, 2.0, 0.0);  // a normal at right angles to the branch: only k_t answers
  across.add(by(c, hertz), y);
  EXPECT_DOUBLE_EQ(across.pressure[5], 10.0 * 2.0);  // F_x r_y: minus the shear stress xy
  EXPECT_DOUBLE_EQ(across.stiffness[yy], 500.0 * 4.0);
  EXPECT_DOUBLE_EQ(across.damping[yy], 0.0);  // it slides
  c.sliding = false;
  c.motion->damped = true;
  NetworkResponse sticking;
  sticking.add(by(c, hertz), y);
  EXPECT_DOUBLE_EQ(sticking.damping[yy], 5.0 * 4.0);
  frictionless.add(by(c, frictionless_hertz), y);
  EXPECT_DOUBLE_EQ(frictionless.stiffness[yy], 0.0);
}

/** The answer of one contact to every way of deforming the box, against the force that its springs give when the branch
 *  is moved. */
TEST(network_response, couples_modes_as_springs_do) {
  const ContactLaw linear = make_law(1.0, TangentialLaw::spring);
  grainscope::Contact c = by(make_contact(), linear);
  c.normal = Eigen::Vector3d(0.6, -0.48, 0.64);
  c.branch = Eigen::Vector3d(1.1, -0.7, 1.6);
  const std::vector<int> all{0, 1, 2, 3, 4, 5};
  NetworkResponse network;
  network.add(c, all);
  for (int a : all)
    for (int b : all) {
      Eigen::Vector3d moved = Eigen::Vector3d::Zero();
      moved[grainscope::box_modes[b].flow] = c.branch[grainscope::box_modes[b].gradient];
      const double along = c.normal.dot(moved);
      const Eigen::Vector3d force = 600.0 * along * c.normal + 500.0 * (moved - along * c.normal);
      const double expected = force[grainscope::box_modes[a].flow] * c.branch[grainscope::box_modes[a].gradient];
      EXPECT_NEAR(network.stiffness[NetworkResponse::place(a, b)], expected, 1e-12 * 600.0 * 4.0) << a << " " << b;
    }
}

/** Of contacts in all directions alike the affine stiffness is known, in units of sum r^2 over volume: K_aa = (3 k + 2
 *  k_t)/15, K_ab = (k - k_t)/15, and of a simple shear, the branch moved along the flow only, (k + 4 k_t)/15. */
TEST(network_response, isotropic_networks_have_the_stiffness_of_mean_field_theory) {
  const ContactLaw linear = make_law(1.0, TangentialLaw::spring);
  const std::vector<int> all{0, 1, 2, 3, 4, 5};
  NetworkResponse network;
  // the 12 axes of an icosahedron: fourth moments of the directions are those of all directions
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  for (int k = 0; k < 3; k++)
    for (double one : {-1.0, 1.0})
      for (double other : {-golden, golden}) {
        grainscope::Contact c = by(make_contact(1.0), linear);
        c.normal[k] = 0.0;
        c.normal[(k + 1) % 3] = one;
        c.normal[(k + 2) % 3] = other;
        c.normal.normalize();
        c.branch = c.normal;
        network.add(c, all);
      }
  const double k_n = 12.0 * 600.0, k_t = 12.0 * 500.0;
  const auto stiffness = [&network](int a, int b) { return network.stiffness[NetworkResponse::place(a, b)]; };
  EXPECT_NEAR(stiffness(0, 0), (3.0 * k_n + 2.0 * k_t) / 15.0, 1e-9);
  EXPECT_NEAR(stiffness(2, 1), (k_n - k_t) / 15.0, 1e-9);
  EXPECT_NEAR(stiffness(5, 5), (k_n + 4.0 * k_t) / 15.0, 1e-9);
  EXPECT_NEAR(stiffness(5, 0), 0.0, 1e-9);
}

TEST(pressure_control, moves_outward_when_the_pressure_is_too_high) {
  PressureControl control;
  control.automatic = false;
  control.gain = 2.0;
  EXPECT_DOUBLE_EQ(control.input(5.0 - 4.9, 0.0, 10.0, 0.1).velocity, 2.0 * (5.0 - 4.9));
  EXPECT_LT(control.input(5.0 - 5.1, 0.0, 10.0, 0.1).velocity, 0.0);
}

TEST(pressure_control, nothing_moves_at_the_target_even_where_nothing_resists) {
  const auto input = PressureControl().input(0.0, 0.0, 10.0, 0.1);
  EXPECT_EQ(input.velocity, 0.0);
  EXPECT_FALSE(input.clipped);
}

TEST(pressure_control, clips_where_nothing_resists) {
  PressureControl control;
  auto input = control.input(-5.0, 0.0, 10.0, 0.1);
  EXPECT_DOUBLE_EQ(input.velocity, -10.0 * 0.01 / 0.1);  // limit per interval
  EXPECT_TRUE(input.clipped);
  control.max_rate = 0.02;
  input = control.input(-5.0, 0.0, 10.0, 0.1);
  EXPECT_DOUBLE_EQ(input.velocity, -10.0 * 0.02);  // limit per time
}

/** A network that answers as it says, P' = -(K x' + eta x'')/L in the box velocity v = L', held between inputs: the
 *  error shrinks by the factor 1 - beta' with 0 < beta' <= beta, for any stiffness, damping and interval. */
TEST(pressure_control, automatic_gain_is_stable_for_any_stiffness_and_damping) {
  for (double stiffness : {1.0, 1e6})
    for (double damping : {0.0, 1e-3, 1e7})
      for (double interval : {1e-4, 1.0}) {
        PressureControl control;
        control.limit = 1e9;
        const double length = 3.0, target = 100.0, resistance = damping + stiffness * interval;
        double elastic = 150.0, velocity = 0.0;
        for (int n = 0; n < 200; n++) {
          const double pressure = elastic - damping * velocity / length;
          velocity = control.input(pressure - target, resistance, length, interval).velocity;
          elastic -= stiffness * velocity * interval / length;
          ASSERT_LT(std::fabs(elastic - damping * velocity / length - target), 60.0)
              << stiffness << " " << damping << " " << interval;
        }
      }
}

TEST(pressure_control, automatic_gain_takes_half_the_error_of_an_elastic_network) {
  PressureControl control;
  control.limit = 1.0;
  const double stiffness = 1e4, length = 3.0, interval = 0.2;
  const double velocity = control.input(150.0 - 100.0, stiffness * interval, length, interval).velocity;
  EXPECT_NEAR(stiffness * velocity * interval / length, 0.5 * 50.0, 1e-12);
}

/** Several modes at once, edges and tilts, each by its own row sum: the recursion of elastic errors, held rates and the
 *  bases of shear rates, averaged over `steps` steps, has no root outside the unit circle in any network; with five
 *  times the gain it has. */
TEST(pressure_control, automatic_gains_of_coupled_modes_are_stable_in_any_network) {
  std::mt19937 random(20251129);
  const std::vector<std::vector<int>> choices = {{0, 1}, {0, 1, 2}, {1, 5}, {0, 1, 2, 3, 4, 5}};
  double largest = 0.0, largest_of_five = 0.0;
  for (int trial = 0; trial < 400; trial++) {
    const std::vector<int> &modes = choices[trial % choices.size()];
    const int n = modes.size(), contacts = 1 + random() % 40, steps = 1 + random() % 30;
    const double interval = std::exp(std::uniform_real_distribution<double>(-7.0, 7.0)(random));
    const NetworkResponse network = random_network(random, contacts, modes);
    const Eigen::MatrixXd k = matrix_of(network.stiffness, modes), eta = matrix_of(network.damping, modes);
    const Eigen::MatrixXd lag = k * (0.5 * interval * (1.0 + 1.0 / steps)) + eta;
    for (double factor : {1.0, 5.0}) {
      PressureControl control;
      control.limit = 1e300;
      // columns: elastic errors, rates, bases
      Eigen::MatrixXd loop = Eigen::MatrixXd::Zero(3 * n, 3 * n);
      loop.block(0, 0, n, n).setIdentity();
      loop.block(0, n, n, n) = -interval * k;
      for (int a = 0; a < n; a++) {
        const double resistance = (eta + interval * k).row(a).cwiseAbs().sum(), elastic = k(a, a) * interval;
        const bool based = modes[a] >= 3 || trial % 2;
        double base = 0.0;
        const double per_error =
            factor * (based ? control.input_with_base(1.0, resistance, elastic, 1.0, interval, base)
                            : control.input(1.0, resistance, 1.0, interval))
                         .velocity;
        Eigen::RowVectorXd error = Eigen::RowVectorXd::Zero(3 * n);
        error[a] = 1.0;
        error.segment(n, n) -= lag.row(a);
        loop.row(n + a) = per_error * error;
        loop(n + a, 2 * n + a) = based ? 1.0 : 0.0;
        loop.row(2 * n + a) = factor * base * error;
        loop(2 * n + a, 2 * n + a) = based ? 1.0 : 0.0;
      }
      const double radius = loop.eigenvalues().cwiseAbs().maxCoeff();
      double &found = factor == 1.0 ? largest : largest_of_five;
      found = std::max(found, radius);
    }
  }
  EXPECT_LT(largest, 1.0 + 1e-6);  // 1: what no contact resists stays as it is; a double root there errs by its root
  EXPECT_GT(largest_of_five, 1.5);
}

TEST(pressure_control, base_of_a_rate_stays_while_it_is_clipped_and_grows_slowly) {
  PressureControl control;
  control.max_rate = 0.1;
  double base = 0.02;
  auto input = control.input_with_base(1e9, 2.0, 1.0, 1.0, 1e-3, base);
  EXPECT_TRUE(input.clipped);
  EXPECT_DOUBLE_EQ(input.velocity, 0.1);
  EXPECT_EQ(base, 0.02);
  input = control.input_with_base(0.01, 2.0, 1.0, 1.0, 1e-3, base);
  EXPECT_DOUBLE_EQ(input.velocity, 0.02 + 0.5 * 0.01 / 2.0);
  EXPECT_DOUBLE_EQ(base, 0.02 + 0.1 * 0.5 * (0.5 * 0.01 / 2.0));
  // of an edge: a velocity, whose base is a rate
  base = 0.02;
  input = control.input_with_base(0.01, 2.0, 1.0, 7.0, 1e-3, base);
  EXPECT_DOUBLE_EQ(input.velocity, 7.0 * (0.02 + 0.5 * 0.01 / 2.0));
  EXPECT_DOUBLE_EQ(base, 0.02 + 0.1 * 0.5 * (0.5 * 0.01 / 2.0));
}

TEST(intervals, first_at_once_then_at_every_multiple) {
  Intervals intervals(1.0);
  int count = 0;
  for (int n = 1; n <= 1000; n++) count += intervals.advance(0.1);
  EXPECT_EQ(count, 101);  // the first step, and 100 multiples, though 0.1 is no binary fraction
}

TEST(intervals, steps_longer_than_the_interval_give_one_each) {
  Intervals intervals(0.3);
  for (int n = 0; n < 10; n++) EXPECT_TRUE(intervals.advance(1.0));
}

TEST(intervals, go_on_where_they_were) {
  Intervals one(0.7), two(0.7);
  for (int n = 0; n < 13; n++) one.advance(0.1);
  two.restore(one.passed(), one.next());
  for (int n = 0; n < 20; n++) EXPECT_EQ(one.advance(0.1), two.advance(0.1));
}

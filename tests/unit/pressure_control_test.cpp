// SPDX-License-Identifier: GPL-2.0-or-later
#include "make_contact.h"
#include "pressure_control.h"
#include <gtest/gtest.h>

using grainscope::ContactLaw;
using grainscope::Intervals;
using grainscope::NetworkResponse;
using grainscope::PressureControl;
using grainscope::TangentialLaw;

namespace {

const ContactLaw hertz = make_law(1.5, TangentialLaw::spring), frictionless_hertz = make_law(1.5, TangentialLaw::none);

}

TEST(network_response, one_contact_by_hand) {
  NetworkResponse along, across, frictionless;
  along.add(by(make_contact(), hertz), 0);
  EXPECT_DOUBLE_EQ(along.pressure, 20.0);                // F_x r_x
  EXPECT_DOUBLE_EQ(along.stiffness, 1.5 * 600.0 * 4.0);  // the tangent of Hertz, n_x = 1
  EXPECT_DOUBLE_EQ(along.damping, 8.0 * 4.0);
  grainscope::Contact c = make_contact();
  c.branch = Eigen::Vector3d(0.0, 2.0, 0.0);  // a normal at right angles to the branch: only k_t answers
  across.add(by(c, hertz), 1);
  EXPECT_DOUBLE_EQ(across.stiffness, 500.0 * 4.0);
  EXPECT_DOUBLE_EQ(across.damping, 0.0);  // it slides
  c.sliding = false;
  c.motion->damped = true;
  NetworkResponse sticking;
  sticking.add(by(c, hertz), 1);
  EXPECT_DOUBLE_EQ(sticking.damping, 5.0 * 4.0);
  frictionless.add(by(c, frictionless_hertz), 1);
  EXPECT_DOUBLE_EQ(frictionless.stiffness, 0.0);
}

TEST(pressure_control, moves_outward_when_the_pressure_is_too_high) {
  PressureControl control;
  control.automatic = false;
  control.gain = 2.0;
  EXPECT_DOUBLE_EQ(control.input({5.0, 0, 0}, 4.9, 10.0, 0.1).velocity, 2.0 * (5.0 - 4.9));
  EXPECT_LT(control.input({5.0, 0, 0}, 5.1, 10.0, 0.1).velocity, 0.0);
}

TEST(pressure_control, nothing_moves_at_the_target_even_where_nothing_resists) {
  const auto input = PressureControl().input({0.0, 0.0, 0.0}, 0.0, 10.0, 0.1);
  EXPECT_EQ(input.velocity, 0.0);
  EXPECT_FALSE(input.clipped);
}

TEST(pressure_control, clips_where_nothing_resists) {
  PressureControl control;
  auto input = control.input({0.0, 0.0, 0.0}, 5.0, 10.0, 0.1);
  EXPECT_DOUBLE_EQ(input.velocity, -10.0 * 0.01 / 0.1);  // limit per interval
  EXPECT_TRUE(input.clipped);
  control.max_rate = 0.02;
  input = control.input({0.0, 0.0, 0.0}, 5.0, 10.0, 0.1);
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
        const double length = 3.0, target = 100.0;
        double elastic = 150.0, velocity = 0.0;
        for (int n = 0; n < 200; n++) {
          const double pressure = elastic - damping * velocity / length;
          velocity = control.input({pressure, stiffness, damping}, target, length, interval).velocity;
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
  const double velocity = control.input({150.0, stiffness, 0.0}, 100.0, length, interval).velocity;
  EXPECT_NEAR(stiffness * velocity * interval / length, 0.5 * 50.0, 1e-12);
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

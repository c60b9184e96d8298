// SPDX-License-Identifier: GPL-2.0-or-later
#include "make_contact.h"
#include "plate_response.h"
#include "pressure_control.h"
#include <cmath>
#include <gtest/gtest.h>

using grainscope::Contact;
using grainscope::PlateResponse;
using grainscope::PressureControl;
using grainscope::TangentialLaw;

namespace {

const grainscope::ContactLaw hertz = make_law(1.5, TangentialLaw::spring),
                             frictionless = make_law(1.5, TangentialLaw::none);

PlateResponse of(const Contact &contact, int axis) {
  PlateResponse response;
  response.add(contact, axis);
  return response;
}

}

TEST(plate_response, one_contact_by_hand) {
  const PlateResponse along = of(by(make_contact(), hertz), 0), across = of(by(make_contact(), hertz), 1);
  EXPECT_DOUBLE_EQ(along.force, -10.0);            // the plate feels the opposite of the grain
  EXPECT_DOUBLE_EQ(along.stiffness, 1.5 * 600.0);  // the tangent of Hertz, n_x = 1
  EXPECT_DOUBLE_EQ(along.damping, 8.0);
  EXPECT_DOUBLE_EQ(across.force, -3.0);
  EXPECT_DOUBLE_EQ(across.stiffness, 500.0);  // k_t
  EXPECT_DOUBLE_EQ(across.damping, 0.0);      // it slides
  EXPECT_DOUBLE_EQ(of(by(make_contact(), frictionless), 1).stiffness, 0.0);
}

TEST(plate_response, inclined_and_sticking) {
  Contact c = by(make_contact(), hertz);
  c.normal = Eigen::Vector3d(0.6, 0.8, 0.0);
  c.motion->damped = true;
  const PlateResponse response = of(c, 1);
  EXPECT_DOUBLE_EQ(response.stiffness, 0.64 * 900.0 + 0.36 * 500.0);
  EXPECT_DOUBLE_EQ(response.damping, 0.64 * 8.0 + 0.36 * 5.0);
}

TEST(plate_response, adds_up) {
  PlateResponse sum;
  sum.add({1.0, 2.0, 3.0}, 0.5);
  sum.add({4.0, 6.0, 8.0}, 2.0);
  EXPECT_EQ(sum.force, 8.5);
  EXPECT_EQ(sum.stiffness, 13.0);
  EXPECT_EQ(sum.damping, 17.5);
}

TEST(plate_response, soft_rate) {
  const double rate = grainscope::soft_rate(2e4, 800.0);
  EXPECT_DOUBLE_EQ(800.0 * rate * rate, 2e2);  // a hundredth of the target
  EXPECT_EQ(grainscope::soft_rate(2e4, 0.0), HUGE_VAL);
}

/** A plate on grains that are held answers F = F_0 - K x - eta v, averaged over the steps of an interval: with the
 *  automatic gain the error decays for any stiffness, damping and number of steps. */
TEST(plate_response, automatic_gain_is_stable_on_grains_that_are_held) {
  for (double stiffness : {0.0, 1.0, 1e6})
    for (double damping : {1e-6, 1e-3, 1e7})
      for (int steps : {1, 3, 50}) {
        PressureControl control;
        control.limit = 1e30;
        const double dt = 1e-3, area = 4.0, target = 100.0, interval = steps * dt;
        double way = 0.0, velocity = 0.0, pressure = 0.0;
        for (int n = 0; n < 200; n++) {
          PlateResponse mean;
          for (int k = 0; k < steps; k++) {
            way += velocity * dt;
            mean.add({600.0 - stiffness * way - damping * velocity, stiffness, damping}, 1.0 / (area * steps));
          }
          pressure = mean.force;
          velocity = control.input(pressure - target, mean.damping + mean.stiffness * interval, 1.0, interval).velocity;
        }
        const double expected = stiffness * interval > damping ? 1e-9 * target : 50.0;
        ASSERT_LT(std::fabs(pressure - target), expected) << stiffness << " " << damping << " " << steps;
      }
}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "grain_power.h"
#include "make_contact.h"
#include <gtest/gtest.h>

using Eigen::Vector3d;

namespace {

const Vector3d force(4.0, 0.0, 1.0), lever_i(-1.0, 0.2, 0.0), lever_j(1.0, 0.2, 0.0);
const double v[6] = {0.3, -0.1, 0.2, -0.4, 0.5, 0.1}, omega[6] = {0.1, 0.2, 0.3, -0.6, 0.4, 0.2};
const double *const v0 = v, *const v1 = v + 3, *const w0 = omega, *const w1 = omega + 3;

double relative_power(const Vector3d &image_velocity) {
  const Vector3d u =
      Vector3d(v0) + Vector3d(w0).cross(lever_i) - Vector3d(v1) - image_velocity - Vector3d(w1).cross(lever_j);
  return force.dot(u);
}

}

TEST(grain_power, is_the_force_times_the_relative_velocity) {
  grainscope::GrainPower power;
  power.reset(2);
  // no ghost: the image velocity is ignored
  power.add(make_contact(), force, lever_i, lever_j, Vector3d(9.0, 9.0, 9.0));
  EXPECT_NEAR(power.power(v, omega), relative_power(Vector3d::Zero()), 1e-15);
}

TEST(grain_power, two_owners_give_the_power_once_with_the_velocity_of_the_image) {
  const Vector3d image(0.7, 0.0, -0.2);
  grainscope::GrainPower power;
  power.reset(2);
  grainscope::Contact c = make_contact(0.5);
  c.partner = grainscope::PartnerGrain{2, true};  // a ghost of grain 1
  power.add(c, force, lever_i, lever_j, image);
  c.i = 1;
  c.partner = grainscope::PartnerGrain{3, true};  // a ghost of grain 0
  power.add(c, -force, lever_j, lever_i, -image);
  EXPECT_NEAR(power.power(v, omega), relative_power(image), 1e-15);
}

TEST(grain_power, at_a_wall_is_against_the_velocity_of_the_wall) {
  const Vector3d wall(0.7, 0.0, -0.2);
  grainscope::GrainPower power;
  power.reset(2);
  grainscope::Contact c = make_contact();
  c.partner = grainscope::PartnerWall();
  power.add(c, force, lever_i, lever_j, wall);
  EXPECT_NEAR(power.power(v, omega), force.dot(Vector3d(v0) + Vector3d(w0).cross(lever_i) - wall), 1e-15);
}

TEST(grain_power, reset_forgets) {
  grainscope::GrainPower power;
  power.reset(2);
  power.add(make_contact(), force, lever_i, lever_j, Vector3d::Zero());
  power.reset(2);
  EXPECT_EQ(power.power(v, omega), 0.0);
}

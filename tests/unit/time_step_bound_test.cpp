// SPDX-License-Identifier: GPL-2.0-or-later
#include "make_contact.h"
#include "time_step_bound.h"
#include <gtest/gtest.h>

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using grainscope::Contact;
using grainscope::TangentialLaw;
using grainscope::time_step::GrainModes;
using grainscope::time_step::of_contact;

// make_contact(): k_n 600, k_t 500, gamma_n 8, gamma_t 5, sliding.
const double dt = 0.01, mass = 2.0, radius = 1.0;
const grainscope::ContactLaw hertz = make_law(1.5, TangentialLaw::none), hooke = make_law(1.0, TangentialLaw::none),
                             sticking_hooke = make_law(1.0, TangentialLaw::spring);
const Matrix3d inertia = 0.4 * mass * radius * radius * Matrix3d::Identity();

TEST(time_step_bound, one_contact_of_equal_spheres_is_exact) {
  GrainModes modes;
  const Contact c = make_contact();
  modes.add(by(c, hertz), Vector3d(-1.0, 0.0, 0.0));
  const double expected = (dt * dt * 900.0 + 2.0 * dt * 8.0) / (0.5 * mass);
  EXPECT_NEAR(modes.fastest(mass, inertia, dt).value, expected, 1e-14);
  EXPECT_NEAR(of_contact(by(c, hertz), 0.5 * mass, dt), expected, 1e-15);
}

TEST(time_step_bound, a_sphere_under_its_tangential_spring_has_two_sevenths_of_its_mass) {
  GrainModes modes;
  Contact c = make_contact();
  c.motion->damping_coefficient = 0.0;
  modes.add(by(c, sticking_hooke), Vector3d(-1.0, 0.0, 0.0));
  // 1/m + r^2/I = 3.5/m; k_t 3.5 = 1750 is more than k_n = 600
  EXPECT_NEAR(modes.fastest(mass, inertia, dt).value, 2.0 * dt * dt * 500.0 * 3.5 / mass, 1e-14);
}

TEST(time_step_bound, tangential_damping_counts_where_the_contact_sticks) {
  Contact c = make_contact();
  c.motion->damping_coefficient = 0.0;
  GrainModes sliding, sticking;
  sliding.add(by(c, sticking_hooke), Vector3d(-1.0, 0.0, 0.0));
  c.sliding = false;
  c.motion->damped = true;
  sticking.add(by(c, sticking_hooke), Vector3d(-1.0, 0.0, 0.0));
  const double difference = sticking.fastest(mass, inertia, dt).value - sliding.fastest(mass, inertia, dt).value;
  EXPECT_NEAR(difference, 2.0 * 2.0 * dt * 5.0 * 3.5 / mass, 1e-14);
}

TEST(time_step_bound, contacts_on_both_sides_add_up) {
  GrainModes one, two;
  Contact c = make_contact();
  one.add(by(c, hooke), Vector3d(-1.0, 0.0, 0.0));
  two.add(by(c, hooke), Vector3d(-1.0, 0.0, 0.0));
  c.normal = -c.normal;
  two.add(by(c, hooke), Vector3d(1.0, 0.0, 0.0));
  EXPECT_NEAR(two.fastest(mass, inertia, dt).value, 2.0 * one.fastest(mass, inertia, dt).value, 1e-14);
}

Contact at_wall() {
  Contact c = make_contact();
  c.partner = grainscope::PartnerWall();
  return c;
}

// Kick and drift against spring and dashpot of make_contact() by Hertz's law, with the velocity of half a step ago.
double moved_at_most(double step) {
  double x = 1e-6, v = 0.0, largest = 0.0;
  for (int k = 0; k < 2000; k++) {
    v -= step * (900.0 * x + 8.0 * v) / mass;
    x += step * v;
    largest = std::max(largest, std::fabs(x));
  }
  return largest;
}

TEST(time_step_bound, the_largest_step_at_a_wall_is_the_true_limit) {
  GrainModes modes;
  modes.add(by(at_wall(), hertz), Vector3d::Zero());
  const double largest = modes.fastest(mass, inertia, dt).largest_step();
  EXPECT_LT(moved_at_most(0.99 * largest), 1e-5);
  EXPECT_GT(moved_at_most(1.01 * largest), 1.0);
}

TEST(time_step_bound, a_wall_does_not_give_way_and_a_grain_does) {
  GrainModes walls, grains, both;
  walls.add(by(at_wall(), hooke), Vector3d(-1.0, 0.0, 0.0));
  grains.add(by(make_contact(), hooke), Vector3d(-1.0, 0.0, 0.0));
  both.add(by(at_wall(), hooke), Vector3d(-1.0, 0.0, 0.0));
  both.add(by(make_contact(), hooke), Vector3d(-1.0, 0.0, 0.0));
  const double wall = walls.fastest(mass, inertia, dt).value;
  EXPECT_NEAR(wall, (dt * dt * 600.0 + 2.0 * dt * 8.0) / mass, 1e-14);
  EXPECT_NEAR(grains.fastest(mass, inertia, dt).value, 2.0 * wall, 1e-14);
  EXPECT_NEAR(both.fastest(mass, inertia, dt).value, 3.0 * wall, 1e-14);
}

TEST(time_step_bound, the_largest_step_is_where_the_limit_is_reached) {
  GrainModes modes;
  modes.add(by(make_contact(), hertz), Vector3d(-1.0, 0.0, 0.0));
  const double largest = modes.fastest(mass, inertia, dt).largest_step();
  EXPECT_NEAR(modes.fastest(mass, inertia, largest).value, 4.0, 1e-12);
}

TEST(time_step_bound, the_largest_step_of_a_dashpot_beside_which_the_spring_is_nothing) {
  EXPECT_NEAR((GrainModes::Mode{0.0, 1.0, 1e10}).largest_step(), 4e-10, 1e-24);
  EXPECT_NEAR((GrainModes::Mode{0.0, 0.0, 1e10}).largest_step(), 4e-10, 1e-24);
}

TEST(time_step_bound, a_disc_stays_in_its_plane) {
  // normal along x: the tangential spring moves a disc along y with its spin, m/3; along z it could not move it
  const Matrix3d disc = 0.5 * mass * radius * radius * Matrix3d::Identity();
  Contact c = make_contact();
  c.motion->damping_coefficient = 0.0;
  GrainModes modes;
  modes.add(by(c, sticking_hooke), Vector3d(-1.0, 0.0, 0.0));
  modes.confine_to_plane();
  EXPECT_NEAR(modes.fastest(mass, disc, dt).value, 2.0 * dt * dt * 500.0 * 3.0 / mass, 1e-14);
  GrainModes across;
  c.normal = Vector3d::UnitZ();
  across.add(by(c, hooke), Vector3d(0.0, 0.0, -1.0));
  across.confine_to_plane();
  EXPECT_EQ(across.fastest(mass, disc, dt).value, 0.0);
}

}

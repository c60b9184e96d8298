// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_measures.h"
#include "make_contact.h"
#include "tangential_bound.h"
#include <gtest/gtest.h>
#include <cmath>
#include <random>

using grainscope::TangentialBound;

namespace {

const double none[3] = {0.0, 0.0, 0.0}, along[3] = {0.0, 2.0, 0.0};

TEST(tangential_bound, without_a_spring_damping_is_the_limit_over_the_speed) {
  EXPECT_DOUBLE_EQ(TangentialBound::largest(5.0, none, along, 3.0), 1.5);
  EXPECT_EQ(TangentialBound::largest(5.0, none, along, 0.0), 0.0);
}

TEST(tangential_bound, below_the_limit_nothing_changes) {
  EXPECT_EQ(TangentialBound::largest(1.5, none, along, 3.0), 1.5);
  EXPECT_EQ(TangentialBound::largest(5.0, none, none, 0.0), 5.0);
}

TEST(tangential_bound, a_spring_takes_its_part_of_the_limit) {
  const double against[3] = {0.0, -1.0, 0.0}, with[3] = {0.0, 1.0, 0.0}, across[3] = {4.0, 0.0, 0.0};
  EXPECT_DOUBLE_EQ(TangentialBound::largest(5.0, against, along, 3.0), 1.0);  // -1 - 2 g = -3
  EXPECT_DOUBLE_EQ(TangentialBound::largest(5.0, with, along, 3.0), 2.0);     //  1 - 2 g = -3
  EXPECT_DOUBLE_EQ(TangentialBound::largest(5.0, across, along, 5.0), 1.5);   // 4^2 + (2 g)^2 = 5^2
  EXPECT_EQ(TangentialBound::largest(5.0, across, along, 4.0), 0.0);
}

TEST(tangential_bound, the_force_ends_at_the_limit_whatever_the_spring) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int n = 0; n < 100000; n++) {
    double f[3], u[3];
    for (int k = 0; k < 3; k++) {
      f[k] = normal(random) * std::pow(10.0, normal(random));
      u[k] = normal(random);
    }
    const double spring = TangentialBound::length(0.0, f, u), limit = spring * (1.0 + std::fabs(normal(random)));
    const double gamma = std::fabs(normal(random)) * 10.0 * limit, g = TangentialBound::largest(gamma, f, u, limit);
    ASSERT_GE(g, 0.0);
    ASSERT_LE(g, gamma);
    const double force = TangentialBound::length(g, f, u);
    if (g < gamma) ASSERT_NEAR(force, limit, 1e-14 * limit + 4e-16 * spring);
    else ASSERT_LE(force, limit);
  }
}

TEST(tangential_bound, off_and_watching_leave_the_force_as_it_is) {
  TangentialBound &bound = TangentialBound::get();
  bound.set(TangentialBound::Mode::off);
  EXPECT_EQ(bound.damping(5.0, none, along, 1.0), 5.0);
  EXPECT_EQ(bound.excess(), 0.0);
  bound.set(TangentialBound::Mode::watch);
  EXPECT_EQ(bound.damping(5.0, none, along, 20.0), 5.0);
  EXPECT_EQ(bound.excess(), 0.0);
  EXPECT_EQ(bound.damping(5.0, none, along, 2.0), 5.0);
  EXPECT_EQ(bound.damping(5.0, none, along, 4.0), 5.0);
  EXPECT_DOUBLE_EQ(bound.excess(), 5.0);
  EXPECT_EQ(bound.damping(5.0, none, along, 0.0), 5.0);
  EXPECT_TRUE(std::isinf(bound.excess()));
  bound.set(TangentialBound::Mode::bound);
  EXPECT_EQ(bound.excess(), 0.0);
  EXPECT_DOUBLE_EQ(bound.damping(5.0, none, along, 3.0), 1.5);
  bound.set(TangentialBound::Mode::off);
}

TEST(mobilisation, is_by_the_limit_of_the_law) {
  grainscope::Contact c = make_contact();
  EXPECT_DOUBLE_EQ(grainscope::mobilisation(c), 1.0);
  c.normal_force = 0.1;  // cohesion pulls: the law's limit stays
  EXPECT_DOUBLE_EQ(grainscope::mobilisation(c), 1.0);
  c.friction_force *= 1.0 + 1e-15;
  EXPECT_EQ(grainscope::mobilisation(c), 1.0);
  c.friction_force = c.tangential_force;
  c.sliding = false;
  c.friction_limit = 12.0;
  EXPECT_DOUBLE_EQ(grainscope::mobilisation(c), 0.25);
  c.friction_limit = 0.0;
  EXPECT_EQ(grainscope::mobilisation(c), 0.0);
}

TEST(mobilisation, of_damping_beyond_the_limit_says_so) {
  grainscope::Contact c = make_contact();
  c.friction_limit = 0.5;
  c.motion->damped = true;
  EXPECT_DOUBLE_EQ(grainscope::mobilisation(c), 6.0);
  EXPECT_EQ(grainscope::friction_loss(c), 0.0);
  c.motion->damped = false;
  EXPECT_DOUBLE_EQ(grainscope::friction_loss(c), 6.0);
}

}

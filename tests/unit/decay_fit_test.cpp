// SPDX-License-Identifier: GPL-2.0-or-later
#include "decay_fit.h"
#include <gtest/gtest.h>
#include <cmath>
#include <limits>

using grainscope::DecayFit;
using grainscope::fit_decay;

namespace {

std::vector<double> middles(int bins, double range) {
  std::vector<double> r;
  for (int k = 0; k < bins; k++) r.push_back((k + 0.5) * range / bins);
  return r;
}

/** d/dlength of the sum of squares over its largest term. */
double stationarity(const std::vector<double> &r, const std::vector<double> &c, double length) {
  double sum = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < r.size(); k++) {
    if (c[k] <= 0.05) continue;
    const double f = std::exp(-r[k] / length), term = (c[k] - f) * f * r[k];
    sum += term;
    largest = std::max(largest, std::fabs(term));
  }
  return std::fabs(sum) / largest;
}

}

TEST(decay_fit, finds_the_length_of_an_exact_exponential) {
  const std::vector<double> r = middles(19, 5.0);
  for (double length : {0.02, 0.3, 1.7, 40.0, 1e5}) {
    std::vector<double> c;
    for (double x : r) c.push_back(std::exp(-x / length));
    const DecayFit fit = fit_decay(r, c);
    if (fit.points == 0) {
      EXPECT_EQ(fit.length, 0.0);
      continue;
    }
    // C is rounded to 1e-16, and its decay is r/length of it.
    EXPECT_NEAR(fit.length / length, 1.0, 4e-16 * std::max(1.0, length) + 1e-14) << length;
    EXPECT_NEAR(fit.error / length, 0.0, 1e-14 * std::max(1.0, length)) << length;
  }
}

TEST(decay_fit, leaves_out_what_is_not_above_a_twentieth) {
  const DecayFit fit = fit_decay({1.0, 2.0, 3.0, 4.0}, {std::exp(-0.5), std::exp(-1.0), 0.05, -0.7});
  EXPECT_EQ(fit.points, 2);
  EXPECT_NEAR(fit.length, 2.0, 1e-14);
}

TEST(decay_fit, is_stationary_for_noisy_points) {
  const std::vector<double> r = middles(19, 7.0);
  for (double noise : {0.01, 0.1, 0.4}) {
    std::vector<double> c;
    for (std::size_t k = 0; k < r.size(); k++) c.push_back(std::exp(-r[k] / 1.3) + noise * std::sin(17.0 * k * k));
    const DecayFit fit = fit_decay(r, c);
    ASSERT_GT(fit.length, 0.0);
    EXPECT_LT(stationarity(r, c, fit.length), 1e-14) << noise;
  }
}

TEST(decay_fit, takes_the_lower_of_two_minima) {
  // One point of short decay near 0, three of long decay far out: the three win.
  const std::vector<double> r{0.01, 10.0, 11.0, 12.0}, c{0.3, 0.60, 0.58, 0.55};
  const DecayFit fit = fit_decay(r, c);
  EXPECT_NEAR(fit.length, 20.0, 1.0);
  EXPECT_LT(stationarity(r, c, fit.length), 1e-14);
}

TEST(decay_fit, error_is_that_of_two_points_worked_by_hand) {
  const std::vector<double> r{1.0, 2.0}, c{0.5, 0.3};
  const DecayFit fit = fit_decay(r, c);
  const double f1 = std::exp(-1.0 / fit.length), f2 = f1 * f1, l2 = fit.length * fit.length;
  const double squares = std::pow(0.5 - f1, 2) + std::pow(0.3 - f2, 2);
  EXPECT_NEAR(fit.error, std::sqrt(squares / (std::pow(f1 / l2, 2) + std::pow(2.0 * f2 / l2, 2))), 1e-15);
}

TEST(decay_fit, one_point_is_met_exactly_and_has_no_error) {
  const DecayFit fit = fit_decay({1.5}, {0.25});
  EXPECT_NEAR(fit.length, 1.5 / std::log(4.0), 1e-15);
  EXPECT_EQ(fit.error, 0.0);
}

TEST(decay_fit, nothing_to_fit_is_zero) {
  for (const DecayFit &fit : {fit_decay({}, {}), fit_decay({1.0, 2.0}, {-0.2, 0.0}), fit_decay({0.0}, {1.0})}) {
    EXPECT_EQ(fit.length, 0.0);
    EXPECT_EQ(fit.error, 0.0);
  }
}

TEST(decay_fit, a_point_at_no_distance_only_counts) {
  const std::vector<double> r{0.0, 1.0, 2.0}, c{1.0, 0.5, 0.3};
  const DecayFit with = fit_decay(r, c), without = fit_decay({1.0, 2.0}, {0.5, 0.3});
  EXPECT_EQ(with.points, 3);
  EXPECT_EQ(with.length, without.length);
  EXPECT_NEAR(with.error, without.error / std::sqrt(2.0), 1e-15);
}

TEST(decay_fit, what_does_not_decay_has_no_length) {
  EXPECT_EQ(fit_decay({1.0, 2.0}, {1.0, 1.0}).length, 0.0);
  EXPECT_EQ(fit_decay({1.0, 2.0}, {1.2, 1.1}).length, 0.0);
  EXPECT_EQ(fit_decay({1.0, 2.0}, {1.2, 1.1}).points, 2);
}

TEST(decay_fit, has_no_length_whatever_the_rounding_of_what_does_not_decay) {
  // A frozen velocity field: C is 1 up to rounding, below or above, evenly or not.
  const std::vector<double> r = middles(50, 0.5);
  for (double eps = 1e-17; eps < 1e-7; eps *= 3.0) {
    std::vector<double> below, above, either, growing;
    for (std::size_t k = 0; k < r.size(); k++) {
      below.push_back(1.0 - eps);
      above.push_back(1.0 + eps);
      either.push_back(1.0 + (k % 3 - 1.0) * eps);
      growing.push_back(1.0 + k * eps);
    }
    for (const std::vector<double> &c : {below, above, either, growing}) {
      const DecayFit fit = fit_decay(r, c);
      EXPECT_EQ(fit.length, 0.0) << eps;
      EXPECT_EQ(fit.error, 0.0) << eps;
      EXPECT_EQ(fit.points, 50) << eps;
    }
  }
}

TEST(decay_fit, tells_a_slow_decay_from_none) {
  // One point is met exactly: -r/ln(1 - eps), a length up to a million times the largest r.
  for (double eps = 1.01e-6; eps <= 1.01e-3; eps *= 10.0) {
    EXPECT_NEAR(fit_decay({2.0}, {1.0 - eps}).length * -std::log1p(-eps) / 2.0, 1.0, 2e-16 / eps) << eps;
    EXPECT_EQ(fit_decay({2.0}, {1.0 + eps}).length, 0.0) << eps;
  }
  EXPECT_EQ(fit_decay({2.0}, {1.0 - 0.99e-6}).length, 0.0);
}

TEST(decay_fit, what_grows_or_is_negative_has_no_length) {
  for (const std::vector<double> &c :
       {std::vector<double>{1.0, 1.5, 2.0}, {1.1, 3.0, 40.0}, {-1.0, -0.5, -0.2}, {0.04, -3.0, 0.0}})
    EXPECT_EQ(fit_decay({1.0, 2.0, 3.0}, c).length, 0.0);
  EXPECT_EQ(fit_decay({1.0, 2.0, 3.0}, {-1.0, -0.5, -0.2}).points, 0);
}

TEST(decay_fit, points_at_no_finite_distance_do_not_count) {
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(fit_decay({infinite, std::nan("")}, {0.5, 0.5}).points, 0);
  const DecayFit with = fit_decay({1.0, infinite, 2.0}, {0.5, 0.4, 0.25}), without = fit_decay({1.0, 2.0}, {0.5, 0.25});
  EXPECT_EQ(with.points, 2);
  EXPECT_EQ(with.length, without.length);
}

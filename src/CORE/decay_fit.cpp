// SPDX-License-Identifier: GPL-2.0-or-later
#include "decay_fit.h"
#include "bin_index.h"
#include <boost/math/tools/toms748_solve.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace grainscope {

namespace {

const int most_intervals = 20000;  // all lengths that a double can be are 15000

/** The points of a fit, with r in units of the largest, and the sum of squares at a length given by its logarithm. */
struct Squares {
  std::vector<double> r, c;

  /** c - exp(-r/length), exact for lengths far beyond r too. */
  double residual(std::size_t k, double length) const { return (c[k] - 1.0) - std::expm1(-r[k] / length); }

  double sum(double length) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < r.size(); k++) sum += std::pow(residual(k, length), 2);
    return sum;
  }

  /** Proportional to the derivative of the sum by length, with its sign. */
  double slope(double log_length) const {
    const double length = std::exp(log_length);
    double slope = 0.0;
    for (std::size_t k = 0; k < r.size(); k++) slope -= residual(k, length) * r[k] * std::exp(-r[k] / length);
    return slope;
  }
};

/** Logarithms of two lengths with every finite minimum between them: each square alone is least at -r/ln c, or grows to
 *  the end. */
std::pair<double, double> search_range(const Squares &squares) {
  const double endless = 1e17;
  double shortest = endless, longest = 0.0;
  for (std::size_t k = 0; k < squares.r.size(); k++) {
    if (squares.r[k] == 0.0) continue;
    const double own = squares.c[k] < 1.0 ? std::min(-squares.r[k] / std::log(squares.c[k]), endless) : endless;
    shortest = std::min(shortest, own);
    longest = std::max(longest, own);
  }
  return {std::log(shortest) - 0.1, std::log(longest) + 0.1};
}

/** Logarithm of the length where the slope vanishes between a and b; it is negative at a and not at b. */
double root(const Squares &squares, double a, double slope_a, double b, double slope_b) {
  if (slope_b == 0.0) return b;
  std::uintmax_t iterations = 200;
  const boost::math::tools::eps_tolerance<double> tolerance(std::numeric_limits<double>::digits);
  const auto bracket = boost::math::tools::toms748_solve([&](double x) { return squares.slope(x); }, a, b, slope_a,
                                                         slope_b, tolerance, iterations);
  return std::fabs(squares.slope(bracket.first)) < std::fabs(squares.slope(bracket.second)) ? bracket.first
                                                                                            : bracket.second;
}

/** The length of the least sum of squares; 0 when none is better than an endless one, or none but lengths as good as
 *  endless. */
double best_length(const Squares &squares) {
  const auto [from, to] = search_range(squares);
  const int intervals = nearest_bin_index(std::ceil((to - from) / 0.1), most_intervals);
  double best = 0.0, least = squares.sum(std::numeric_limits<double>::infinity());
  double a = from, slope_a = squares.slope(a);
  for (int k = 1; k <= intervals; k++) {
    const double b = from + k * (to - from) / intervals, slope_b = squares.slope(b);
    if (slope_a < 0.0 && slope_b >= 0.0) {
      const double length = std::exp(root(squares, a, slope_a, b, slope_b)), sum = squares.sum(length);
      if (sum < least) {
        best = length;
        least = sum;
      }
    }
    a = b;
    slope_a = slope_b;
  }
  return best <= longest_decay ? best : 0.0;
}

}

DecayFit fit_decay(const std::vector<double> &r, const std::vector<double> &c) {
  Squares squares;
  for (std::size_t k = 0; k < r.size(); k++) {
    if (!(c[k] > 0.05 && r[k] < HUGE_VAL)) continue;
    squares.r.push_back(r[k]);
    squares.c.push_back(c[k]);
  }
  DecayFit fit;
  fit.points = static_cast<int>(squares.r.size());
  const double scale = fit.points > 0 ? *std::max_element(squares.r.begin(), squares.r.end()) : 0.0;
  if (scale == 0.0) return fit;
  for (double &value : squares.r) value /= scale;
  const double length = best_length(squares);
  fit.length = scale * length;
  if (fit.points < 2 || length == 0.0) return fit;
  double sensitivity = 0.0;
  for (double x : squares.r) sensitivity += std::pow(std::exp(-x / length) * x / (length * length), 2);
  fit.error = scale * std::sqrt(squares.sum(length) / (fit.points - 1) / sensitivity);
  return fit;
}

}

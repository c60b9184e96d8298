// SPDX-License-Identifier: GPL-2.0-or-later
#include "decay_fit.h"
#include "input.h"
#include <algorithm>

using fuzz::require;
using fuzz::require_below;
using grainscope::DecayFit;
using grainscope::fit_decay;

namespace {

/** Sum of squares over the points that count. */
double squares(const std::vector<double> &r, const std::vector<double> &c, double length) {
  double sum = 0.0;
  for (std::size_t k = 0; k < r.size(); k++)
    if (c[k] > 0.05) sum += std::pow((c[k] - 1.0) - std::expm1(-r[k] / length), 2);
  return sum;
}

}

/** Which is 1 within `eps` at every distance. */
void check_frozen(fuzz::Input &input, const std::vector<double> &r) {
  const double eps = input.logarithmic(1e-17, 1e-7);
  std::vector<double> c;
  for (std::size_t k = 0; k < r.size(); k++) c.push_back(1.0 + eps * input.small());
  double nearest = HUGE_VAL, farthest = 0.0;
  for (double x : r) {
    if (x > 0.0) nearest = std::min(nearest, x);
    farthest = std::max(farthest, x);
  }
  // A point so near that its decay would be seen decides for itself.
  const double length = fit_decay(r, c).length;
  if (farthest < 2.0 * nearest) require(length == 0.0, "what does not decay has no length", length, eps);
}

/** A fit of whatever a correlation may be: no length has a smaller sum of squares, and another unit of r changes
 *  nothing. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzz::Input input(data, size);
  const bool anything = input.byte() < 32, decaying = input.flag();
  const int n = input.whole(0, 20);
  const double true_length = input.logarithmic(0.01, 100.0);
  std::vector<double> r, c, scaled;
  for (int k = 0; k < n; k++) {
    r.push_back(anything ? std::fabs(input.any()) : input.logarithmic(1e-6, 1e3));
    if (input.byte() < 8) r.back() = 0.0;
    c.push_back(anything   ? input.any()
                : decaying ? std::exp(-r.back() / true_length) + 0.1 * input.small()
                           : 1.5 * input.small());
    scaled.push_back(64.0 * r.back());
  }
  const DecayFit fit = fit_decay(r, c);
  int points = 0;
  for (int k = 0; k < n; k++) points += c[k] > 0.05 && r[k] < HUGE_VAL;
  require(fit.points == points, "all points above 0.05 count", fit.points);
  if (anything) return 0;
  require(std::isfinite(fit.length) && fit.length >= 0.0, "a length is finite and not negative", fit.length);
  require(std::isfinite(fit.error) && fit.error >= 0.0, "its error too", fit.error);
  double largest = 0.0;
  for (int k = 0; k < n; k++)
    if (c[k] > 0.05) largest = std::max(largest, r[k]);
  require_below(fit.length, grainscope::longest_decay * largest * (1.0 + 1e-12), "longer lengths are endless");
  check_frozen(input, r);
  const double least = squares(r, c, fit.length > 0.0 ? fit.length : HUGE_VAL);
  // Where the best length is beyond a million times the largest r, endless is as good up to n (r/length)^2.
  const double rounding = fit.length > 0.0 ? 1e-15 : 1e-15 + n * 1e-12;
  for (double factor : {0.01, 0.3, 0.8, 0.99, 1.01, 1.25, 3.0, 100.0}) {
    const double other = (fit.length > 0.0 ? fit.length : true_length) * factor;
    if (other > grainscope::longest_decay * largest) continue;
    require_below(least, squares(r, c, other) * (1.0 + 1e-12) + rounding, "no other length fits better");
  }
  if (fit.points)
    require_below(least, squares(r, c, HUGE_VAL) * (1.0 + 1e-12) + 1e-15, "an endless length fits no better");
  const DecayFit other = fit_decay(scaled, c);
  require(other.length == 64.0 * fit.length && other.error == 64.0 * fit.error, "another unit gives the same length",
          other.length);
  return 0;
}

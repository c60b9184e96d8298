// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_DECAY_FIT_H
#define GRAINSCOPE_DECAY_FIT_H

#include <vector>

namespace grainscope {

/** Least-squares fit of exp(-r/length), which is 1 at r = 0, to the points with c > 0.05, 0 <= r < infinity (a point at
 *  r = 0 only counts as a point). length minimises S = sum (c - exp(-r/length))^2; error = sqrt(S/(points - 1) / sum (d
 *  exp(-r/length)/d length)^2). */
struct DecayFit {
  double length = 0.0;  // 0 without points, and when c does not decay: the best is beyond longest_decay x the largest r
  double error = 0.0;   // standard error of length; 0 with fewer than two points
  int points = 0;
};

/** In units of the largest r: a longer decay is no more than rounding of c, and cannot be measured. */
constexpr double longest_decay = 1e6;

DecayFit fit_decay(const std::vector<double> &r, const std::vector<double> &c);

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_DIRECTION_SUMS_H
#define GRAINSCOPE_DIRECTION_SUMS_H

#include "bin_index.h"
#include "contact.h"
#include <cmath>
#include <vector>

namespace grainscope {

/** Contacts binned by the angle beta of their normal in a plane, Bilotto et al. 2025, Eq. (F1). Bins are from 0 to pi:
 *  beta and beta + pi are one line, and the component of F_t along (-sin beta, cos beta) is the same for both
 *  grains. */
class DirectionSums {
 public:
  struct Bin {
    double contacts, normal, tangential, along;
  };

  /** `flow`, `gradient`: the axes that beta is measured from and towards. */
  explicit DirectionSums(int flow = 0, int gradient = 1, int bins = 36)
      : flow_(flow), gradient_(gradient), bins_(bins) {
    reset();
  }

  int bins() const { return bins_; }
  double width() const { return M_PI / bins_; }
  void reset() { numbers_.assign(bins_ * per_bin + 1, 0.0); }

  void add(const Contact &c) {
    const int a = flow_, b = gradient_;
    const auto projected = [a, b](const Eigen::Vector3d &v) { return std::sqrt(v[a] * v[a] + v[b] * v[b]); };
    const double length = projected(c.normal);
    if (length < 1e-9) return;
    double beta = std::atan2(c.normal[b], c.normal[a]);
    if (beta < 0.0) beta += M_PI;
    const int upto_pi = bin_index(beta / M_PI * bins_, bins_ + 1);
    if (upto_pi < 0) {
      numbers_.back() += c.weight;
      return;
    }
    const double along = (c.tangential_force[b] * c.normal[a] - c.tangential_force[a] * c.normal[b]) / length;
    double *s = &numbers_[upto_pi % bins_ * per_bin];
    s[0] += c.weight;
    s[1] += c.weight * std::fabs(c.normal_force) * length;
    s[2] += c.weight * projected(c.tangential_force);
    s[3] += c.weight * along;
  }

  Bin bin(int k) const {
    const double *s = &numbers_[k * per_bin];
    return {s[0], s[1], s[2], s[3]};
  }
  double contacts() const {
    double sum = 0.0;
    for (int k = 0; k < bins_; k++) sum += bin(k).contacts;
    return sum;
  }
  /** Contacts whose direction is not finite. */
  double not_finite() const { return numbers_.back(); }
  std::vector<double> &numbers() { return numbers_; }

 private:
  static constexpr int per_bin = 4;
  int flow_, gradient_, bins_;
  std::vector<double> numbers_;  // of each bin; then contacts that are in none
};

}

#endif

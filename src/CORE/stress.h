// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_STRESS_H
#define GRAINSCOPE_STRESS_H

#include "contact.h"
#include <algorithm>
#include <array>

namespace grainscope {

/** Sums over contacts that make up the contact stress, Bilotto et al. 2025, Eq. (2); plain doubles, so that ranks add them up. */
struct StressSums {
  std::array<double, 21> sums{};  // F_a r_b (9, by rows), the same with F_t (9), contacts, sliding contacts, overlaps
  double largest_overlap = 0.0;

  void add(const Contact &c) {
    const Eigen::Vector3d r = c.weight * c.branch;
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < 3; b++) {
        sums[3 * a + b] += c.force[a] * r[b];
        sums[9 + 3 * a + b] += c.tangential_force[a] * r[b];
      }
    sums[18] += c.weight;
    if (c.sliding) sums[19] += c.weight;
    sums[20] += c.weight * c.overlap;
    largest_overlap = std::max(largest_overlap, c.overlap);
  }
  double contacts() const { return sums[18]; }
  double sliding() const { return sums[19]; }
  double overlaps() const { return sums[20]; }
  /** -1/volume sum F_a r_b: tension positive. */
  Eigen::Matrix3d total(double volume) const { return stress(0, volume); }
  Eigen::Matrix3d tangential(double volume) const { return stress(9, volume); }

 private:
  Eigen::Matrix3d stress(int first, double volume) const {
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&sums[first]) / -volume;
  }
};

}

#endif

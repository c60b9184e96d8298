// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_STRESS_H
#define GRAINSCOPE_STRESS_H

#include "contact.h"
#include <algorithm>
#include <array>

namespace grainscope {

/** Sums over contacts that make up the contact stress, Bilotto et al. 2025, Eq. (2); plain doubles, so that ranks add
 *  them up. */
struct StressSums {
  // For b = x, y, z: F_x r_b, F_y r_b, F_z r_b and the same with F_t; then contacts between grains, contacts with
  // walls, and of both together those that slide, and overlaps.
  std::array<double, 22> sums{};
  double largest_overlap = 0.0;

  void add(const Contact &c) {
    add_moments(c, c.weight * c.branch);
    count(c);
  }
  /** `r`: the branch, or the part of it that counts, times the weight of the contact. */
  [[gnu::always_inline]] void add_moments(const Contact &c, const Eigen::Vector3d &r) {
    Eigen::Matrix<double, 6, 1> forces;
    forces << c.force, c.tangential_force;
    Moments(sums.data()).noalias() += forces * r.transpose();
  }
  void count(const Contact &c) {
    sums[c.with_wall() ? 19 : 18] += c.weight;
    sums[20] += c.sliding ? c.weight : 0.0;
    sums[21] += c.weight * c.overlap;
    largest_overlap = std::max(largest_overlap, c.overlap);
  }
  void reset() { *this = StressSums(); }
  std::array<double, 22> &numbers() { return sums; }
  double contacts_of_grains() const { return sums[18]; }
  double contacts_with_walls() const { return sums[19]; }
  double contacts() const { return contacts_of_grains() + contacts_with_walls(); }
  double sliding() const { return sums[20]; }
  double overlaps() const { return sums[21]; }
  /** -1/volume sum F_a r_b: tension positive. */
  Eigen::Matrix3d total(double volume) const { return ConstMoments(sums.data()).topRows<3>() / -volume; }
  Eigen::Matrix3d tangential(double volume) const { return ConstMoments(sums.data()).bottomRows<3>() / -volume; }

 private:
  using Moments = Eigen::Map<Eigen::Matrix<double, 6, 3>>;
  using ConstMoments = Eigen::Map<const Eigen::Matrix<double, 6, 3>>;
};

}

#endif

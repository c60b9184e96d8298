// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FORCE_STATISTICS_H
#define GRAINSCOPE_FORCE_STATISTICS_H

#include "bin_index.h"
#include "contact.h"
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace grainscope {

/** Forces that differ by less than this share of the mean are taken for equal to it, so that rounding, which is not the
 *  same on one rank and on four, does not choose the strong contacts of a lattice where all forces are the same. */
const double equal_forces = 1e-9;

/** F_n > <F_n>. */
inline bool is_strong(double normal, double mean) { return normal > mean + equal_forces * std::fabs(mean); }

/** What is kept of a contact until the mean force is known. */
struct ContactForce {
  double normal = 0.0, tangential = 0.0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), branch = Eigen::Vector3d::Zero();
  bool with_wall = false;

  ContactForce() = default;
  ContactForce(const Contact &c, const Eigen::Vector3d &branch)
      : normal(c.normal_force), tangential(c.tangential_force.norm()), force(c.force), branch(branch),
        with_wall(c.with_wall()) {}
};

/** Moments of the contact forces. */
struct ForceMoments {
  double largest_normal = -HUGE_VAL, largest_tangential = 0.0;  // of this rank
  std::array<double, 7> sums{};

  void reset() { *this = ForceMoments(); }
  void add(const ContactForce &c) {
    sums[c.with_wall ? 1 : 0] += 1.0;
    if (!std::isfinite(c.normal) || !std::isfinite(c.tangential)) {
      sums[6] += 1.0;
      return;
    }
    sums[2] += c.normal;
    sums[3] += c.normal * c.normal;
    sums[4] += c.tangential;
    sums[5] += c.tangential * c.tangential;
    largest_normal = std::max(largest_normal, c.normal);
    largest_tangential = std::max(largest_tangential, c.tangential);
  }
  std::array<double, 7> &numbers() { return sums; }
  double of_grains() const { return sums[0]; }
  double with_walls() const { return sums[1]; }
  double contacts() const { return sums[0] + sums[1]; }
  double normal() const { return sums[2]; }
  double normal_squared() const { return sums[3]; }
  double tangential() const { return sums[4]; }
  double tangential_squared() const { return sums[5]; }
  double not_finite() const { return sums[6]; }
  double mean_normal() const { return contacts() > 0.0 ? normal() / contacts() : 0.0; }
};

/** Distribution of f = F_n/<F_n>, and what the strong contacts, f > 1, carry. Nothing is counted in bins, tail and weak
 *  part where <F_n> is not positive. */
class ForceDistribution {
 public:
  /** `bins` from 0 to `most`; the tail begins at `tail`. */
  explicit ForceDistribution(int bins = 1, double most = 1.0, double tail = 1.0)
      : bins_(bins), most_(most), tail_(tail) {
    reset();
  }
  void reset() { numbers_.assign(bins_ + others + 2 * 9, 0.0); }

  /** `mean`: <F_n>. */
  void add(const ContactForce &c, double mean) {
    const bool strong = is_strong(c.normal, mean);
    add_moment(0, c);
    if (strong) add_moment(1, c);
    if (strong) other(STRONG) += 1.0;
    if (c.normal < 0.0) other(NEGATIVE) += 1.0;
    if (!(mean > 0.0)) return;
    const double f = c.normal / mean;
    const int bin = bin_index(f / most_ * bins_, bins_);
    if (bin >= 0) numbers_[bin] += 1.0;
    if (f > tail_ + equal_forces) {
      other(TAIL) += 1.0;
      other(TAIL_SUM) += f - tail_;
    }
    if (f > 0.0 && f < 1.0 - equal_forces) {
      other(WEAK) += 1.0;
      other(WEAK_SUM) -= std::log(f);
    }
  }
  std::vector<double> &numbers() { return numbers_; }

  int bins() const { return bins_; }
  double width() const { return most_ / bins_; }
  double in_bin(int k) const { return numbers_[k]; }
  double strong() const { return other(STRONG); }
  double negative() const { return other(NEGATIVE); }
  double tail() const { return other(TAIL); }
  double tail_sum() const { return other(TAIL_SUM); }
  double weak() const { return other(WEAK); }
  double weak_sum() const { return other(WEAK_SUM); }
  /** beta of P ~ exp(-beta f) beyond the tail's begin, of largest likelihood: n/sum (f - f0). */
  double tail_exponent() const { return tail_sum() > 0.0 ? tail() / tail_sum() : 0.0; }
  double tail_error() const { return tail() > 0.0 ? tail_exponent() / std::sqrt(tail()) : 0.0; }
  /** alpha of P ~ f^-alpha from 0 to 1, of largest likelihood: 1 - n/sum (-ln f). */
  double weak_exponent() const { return weak_sum() > 0.0 ? 1.0 - weak() / weak_sum() : 0.0; }
  double weak_error() const { return weak_sum() > 0.0 ? std::sqrt(weak()) / weak_sum() : 0.0; }
  /** Share of the strong contacts in the trace of sum F r. */
  double strong_pressure() const {
    const double all = moment(0).trace();
    return all != 0.0 ? moment(1).trace() / all : 0.0;
  }
  /** Share of the strong contacts in the deviator D of sum F r: D_strong : D/(D : D). With the share of the others it
   *  makes 1. */
  double strong_deviator(int dimension) const {
    const Eigen::Matrix3d all = deviator(moment(0), dimension);
    const double square = all.squaredNorm();
    return square > 0.0 ? deviator(moment(1), dimension).cwiseProduct(all).sum() / square : 0.0;
  }

 private:
  enum { STRONG, NEGATIVE, TAIL, TAIL_SUM, WEAK, WEAK_SUM, others };
  int bins_;
  double most_, tail_;
  std::vector<double> numbers_;  // of each bin; others; sum F r of all, of the strong

  double &other(int which) { return numbers_[bins_ + which]; }
  double other(int which) const { return numbers_[bins_ + which]; }
  void add_moment(int of, const ContactForce &c) {
    Eigen::Map<Eigen::Matrix3d>(&numbers_[bins_ + others + 9 * of]) += c.force * c.branch.transpose();
  }
  Eigen::Matrix3d moment(int of) const { return Eigen::Map<const Eigen::Matrix3d>(&numbers_[bins_ + others + 9 * of]); }
  /** Symmetric, without trace; of a plane its x and y. */
  static Eigen::Matrix3d deviator(const Eigen::Matrix3d &m, int dimension) {
    Eigen::Matrix3d d = 0.5 * (m + m.transpose());
    const double mean = d.trace() / dimension;
    for (int k = 0; k < dimension; k++) d(k, k) -= mean;
    return d;
  }
};

}

#endif

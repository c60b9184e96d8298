// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FABRIC_H
#define GRAINSCOPE_FABRIC_H

#include "contact.h"
#include "symmetric_tensor.h"
#include <array>

namespace grainscope {

/** Sum of n n over contacts, each once, Bilotto et al. 2025, Eq. (9); plain doubles, so that ranks add them up. */
struct FabricSums {
  std::array<double, 7> sums{};  // xx yy zz xy xz yz, contacts

  void add(const Contact &c) {
    add_components(sums.data(), c.weight, dyad(c.normal, c.normal));
    sums[6] += c.weight;
  }
  void reset() { sums.fill(0.0); }
  std::array<double, 7> &numbers() { return sums; }
  double contacts() const { return sums[6]; }
  /** <n n>, trace 1; zero without contacts. */
  Eigen::Matrix3d tensor() const;
};

/** What the weighted tensors need of a contact. */
struct ContactMoment {
  Eigen::Vector3d normal;
  double weight, distance, normal_force, tangential_force;
};

/** Size of the deviator of a fabric, from 0 (isotropic) to 1 (one direction in the plane of two dimensions); in three
 *  dimensions at most 1 too: sqrt(d/(d - 1) F':F'), d = `dimension`, F' = F - tr F/d. */
double fabric_deviator(const Eigen::Matrix3d &fabric, int dimension);

/** The tensors of LAMMPS's compute fabric (Ouadfel & Rothenburg 2001), with the true contact normal n and
 *  r = |x_i - x_j|, in d = 2 or 3 dimensions:
 *  a = d (d + 2)/2 (F - 1/d), w = 1/(1 + a:nn), and the sums of w r n n, w f_n n n, w |F_t| n n over contacts, each
 *  once. The mean over contacts that the definition asks for cancels in the tensors. The coefficients follow from
 *  means over all directions n, < n_a n_b > = delta_ab/d and < n_a n_b n_c n_d > = (delta_ab delta_cd + ...)/(d (d +
 *  2)): of a density proportional to 1 + a:nn, a traceless, they give a back. d = 3: 15/2 and 5; d = 2: 4 and 4. */
class WeightedFabricSums {
 public:
  // branch, normal force, tangential force: xx yy zz xy xz yz each; then contacts with 1 + a:nn = 0 (within 1e-10)
  std::array<double, 19> sums{};

  explicit WeightedFabricSums(int dimension = 3) : dimension_(dimension) {}
  /** `fabric`: <n n> of all contacts. */
  void add(const ContactMoment &m, const Eigen::Matrix3d &fabric);
  double singular() const { return sums[18]; }
  /** Traceless, d (d + 2)/(2 tr D) (D - tr D/d). All three are zero where their trace is, or with a contact where 1 +
   *  a:nn = 0. */
  Eigen::Matrix3d branch() const;
  /** d (d + 2)/(2 tr N) (N - tr N/d). */
  Eigen::Matrix3d normal_force() const;
  /** (d + 2)/(tr N) (T - tr T/d). */
  Eigen::Matrix3d tangential_force() const;

 private:
  int dimension_;

  double of_density() const { return 0.5 * dimension_ * (dimension_ + 2); }
  Eigen::Matrix3d deviatoric_over(double scale, const Eigen::Matrix3d &m) const;
};

}

#endif

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

/** The tensors of LAMMPS's compute fabric (Ouadfel & Rothenburg 2001), with the true contact normal n and
 *  r = |x_i - x_j|:
 *  a = 15/2 (F - 1/3), w = 1/(1 + a:nn), and the sums of w r n n, w f_n n n, w |F_t| n n over contacts, each once. The
 *  mean over contacts that the definition asks for cancels in the tensors. */
struct WeightedFabricSums {
  // branch, normal force, tangential force: xx yy zz xy xz yz each; then contacts with 1 + a:nn = 0 (within 1e-10)
  std::array<double, 19> sums{};

  /** `fabric`: <n n> of all contacts. */
  void add(const ContactMoment &m, const Eigen::Matrix3d &fabric);
  double singular() const { return sums[18]; }
  /** Traceless, 15/(2 tr D) (D - tr D/3). All three are zero where their trace is, or with a contact where 1 + a:nn =
   *  0. */
  Eigen::Matrix3d branch() const;
  /** 15/(2 tr N) (N - tr N/3). */
  Eigen::Matrix3d normal_force() const;
  /** 5/(tr N) (T - tr T/3). */
  Eigen::Matrix3d tangential_force() const;
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SYMMETRIC_TENSOR_H
#define GRAINSCOPE_SYMMETRIC_TENSOR_H

#include <Eigen/Core>
#include <array>

namespace grainscope {

/** Symmetric tensors as six numbers, xx yy zz xy xz yz: in sums that ranks add up, and in all outputs. */
using SixComponents = std::array<double, 6>;

/** a_x b_x, a_y b_y, a_z b_z, a_x b_y, a_x b_z, a_y b_z, of vectors that are parallel. */
template <class A, class B>
SixComponents dyad(const A &a, const B &b) {
  return {{a[0] * b[0], a[1] * b[1], a[2] * b[2], a[0] * b[1], a[0] * b[2], a[1] * b[2]}};
}

/** Adds a tensor to six numbers. */
inline void add_components(double *sums, const SixComponents &tensor) {
  for (int k = 0; k < 6; k++) sums[k] += tensor[k];
}
inline void add_components(double *sums, double weight, const SixComponents &tensor) {
  for (int k = 0; k < 6; k++) sums[k] += weight * tensor[k];
}

/** The tensor that six numbers stand for. */
inline Eigen::Matrix3d symmetric_tensor(const double *six) {
  Eigen::Matrix3d m;
  m << six[0], six[3], six[4], six[3], six[1], six[5], six[4], six[5], six[2];
  return m;
}

/** m less its isotropic part, tr m/d in each of the d = `dimension` directions; with d = 2 these are x and y, and m has
 *  no component along z. */
inline Eigen::Matrix3d deviatoric(const Eigen::Matrix3d &m, int dimension) {
  Eigen::Matrix3d unit = Eigen::Matrix3d::Identity();
  if (dimension == 2) unit(2, 2) = 0.0;
  return m - m.trace() / dimension * unit;
}

/** Writes the upper triangle of m as six numbers; returns the place behind them. */
inline double *write_components(const Eigen::Matrix3d &m, double *to) {
  for (double value : {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)}) *to++ = value;
  return to;
}

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FIELD_KERNEL_H
#define GRAINSCOPE_FIELD_KERNEL_H

#include <Eigen/Core>

namespace grainscope {

/** A function of the distance that spreads a point over its surroundings: its integral over the space of `dimensions`
 *  axes is 1, and beyond 3 widths it is 0. Gaussian: C exp(-r^2/2 w^2). Lucy: C (1 + 3 q)(1 - q)^3, q = r/3 w.
 *  Goldhirsch 2010, doi 10.1007/s10035-010-0181-z; Weinhart et al. 2012, doi 10.1007/s10035-012-0317-4. */
class FieldKernel {
 public:
  enum class Kind { cell, lucy, gaussian };  // cell: no such function, but all in the cell that holds the point

  FieldKernel() = default;
  FieldKernel(Kind kind, double width, int dimensions);

  bool is_smooth() const { return kind_ != Kind::cell; }
  /** Where it ends. */
  double range() const { return range_; }
  /** At a distance whose square is given. */
  double at(double square) const;
  /** Its integral over t from `low` to `high` along the line p + t d, p and d in the space of its axes, from the point
   *  that it is about: in closed form. */
  double along(const Eigen::Vector3d &p, const Eigen::Vector3d &d, double low, double high) const;

 private:
  Kind kind_ = Kind::cell;
  double width_ = 1.0, range_ = 3.0, scale_ = 1.0;

  double mean_of(const Eigen::Vector3d &p, const Eigen::Vector3d &d, double begin, double end) const;
  double gaussian_along(double square, double s) const;
  double lucy_along(double square, double s) const;
};

}

#endif

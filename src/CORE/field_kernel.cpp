// SPDX-License-Identifier: GPL-2.0-or-later
#include "field_kernel.h"
#include <algorithm>
#include <cmath>

namespace grainscope {

namespace {

// In units of the range: along shorter lines the difference of two closed forms loses its digits, and five points err
// by less than 1e-9 of the height.
const double short_line = 1e-3;

/** Of the function without its scale, of width w, which ends at c. */
double integral(FieldKernel::Kind kind, int dimensions, double w, double c) {
  if (kind == FieldKernel::Kind::lucy) {
    if (dimensions == 1) return 0.8 * c;
    return (dimensions == 2 ? 0.2 : 16.0 / 105.0 * c) * M_PI * c * c;
  }
  const double all = std::sqrt(2.0 * M_PI) * w, end = c / w;
  const double inside = std::erf(end / std::sqrt(2.0)), at_end = std::exp(-0.5 * end * end);
  if (dimensions == 1) return all * inside;
  if (dimensions == 2) return all * all * (1.0 - at_end);
  return all * all * all * (inside - std::sqrt(2.0 / M_PI) * end * at_end);
}

}

FieldKernel::FieldKernel(Kind kind, double width, int dimensions) : kind_(kind), width_(width), range_(3.0 * width) {
  scale_ = 1.0 / integral(kind, dimensions, width_, range_);
}

double FieldKernel::at(double square) const {
  if (!(square < range_ * range_)) return 0.0;
  if (kind_ == Kind::gaussian) return scale_ * std::exp(-0.5 * square / (width_ * width_));
  const double q = std::sqrt(square) / range_, p = 1.0 - q;
  return scale_ * (1.0 + 3.0 * q) * p * p * p;
}

double FieldKernel::along(const Eigen::Vector3d &p, const Eigen::Vector3d &d, double low, double high) const {
  const double dd = d.squaredNorm();
  if (!(dd > 1e-24 * range_ * range_)) return at(p.squaredNorm()) * (high - low);
  const double nearest = -p.dot(d) / dd, square = std::max(0.0, p.squaredNorm() - nearest * nearest * dd);
  if (!(square < range_ * range_)) return 0.0;
  const double half_chord = std::sqrt((range_ * range_ - square) / dd), length = std::sqrt(dd);
  const double begin = std::max(low, nearest - half_chord), end = std::min(high, nearest + half_chord);
  if (begin >= end) return 0.0;
  if ((end - begin) * length < short_line * range_) return (end - begin) * mean_of(p, d, begin, end);
  const double s1 = (begin - nearest) * length, s2 = (end - nearest) * length;
  if (kind_ == Kind::gaussian) return scale_ * (gaussian_along(square, s2) - gaussian_along(square, s1)) / length;
  return scale_ * (lucy_along(square, s2) - lucy_along(square, s1)) / length;
}

/** Over t from `begin` to `end`, by the points of Gauss and Legendre. */
double FieldKernel::mean_of(const Eigen::Vector3d &p, const Eigen::Vector3d &d, double begin, double end) const {
  const double inner = std::sqrt(5.0 - 2.0 * std::sqrt(10.0 / 7.0)) / 3.0;
  const double outer = std::sqrt(5.0 + 2.0 * std::sqrt(10.0 / 7.0)) / 3.0;
  const double of_inner = (322.0 + 13.0 * std::sqrt(70.0)) / 900.0, of_outer = (322.0 - 13.0 * std::sqrt(70.0)) / 900.0;
  const auto value = [&](double u) { return at((p + (begin + 0.5 * (1.0 + u) * (end - begin)) * d).squaredNorm()); };
  return 0.5 * (128.0 / 225.0 * value(0.0) + of_inner * (value(-inner) + value(inner)) +
                of_outer * (value(-outer) + value(outer)));
}

/** Integral from 0 to s along a line that passes at a distance whose square is given. */
double FieldKernel::gaussian_along(double square, double s) const {
  return std::exp(-0.5 * square / (width_ * width_)) * std::sqrt(0.5 * M_PI) * width_ *
         std::erf(s / (std::sqrt(2.0) * width_));
}

/** Of 1 - 6 q^2 + 8 q^3 - 3 q^4, q^2 = (square + s^2)/c^2. */
double FieldKernel::lucy_along(double square, double s) const {
  const double c = range_, ss = s * s, r = std::sqrt(square + ss);
  const double turn = square > 0.0 ? square * square * std::asinh(s / std::sqrt(square)) : 0.0;
  const double second = s * (square + ss / 3.0), third = (s * r * (2.0 * ss + 5.0 * square) + 3.0 * turn) / 8.0;
  const double fourth = s * (square * square + 2.0 / 3.0 * square * ss + ss * ss / 5.0);
  return s + (-6.0 * second + (8.0 * third - 3.0 * fourth / c) / c) / (c * c);
}

}

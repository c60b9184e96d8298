// SPDX-License-Identifier: GPL-2.0-or-later
#include "nematic.h"
#include "lane_rows.h"
#include "principal_axes.h"
#include "symmetric_tensor.h"
#include <cmath>

namespace grainscope {

namespace {

/** Sums in the order of NematicSums, of one grain or four. */
template <class Real>
struct Part {
  Real sums[14]{};

  GRAINSCOPE_INLINE void add_spin(const double *omega) {
    Real w[3];
    read_threes(omega, w);
    for (int k = 0; k < 3; k++) sums[11 + k] += w[k];
  }
  /** Eigen's product of a quaternion and unit vector `index`. */
  GRAINSCOPE_INLINE void add_axis(const double *quaternion, int index, int flow, int gradient, double sign) {
    Real q[4], p[3];
    read_fours(quaternion, q);
    const int next = (index + 1) % 3, last = (index + 2) % 3;
    const Real a = q[1 + index], b = q[1 + next], c = q[1 + last], c2 = c + c, b2 = b + b;
    p[index] = 1.0 - (b * b2 + c * c2);
    p[next] = q[0] * c2 + a * b2;
    p[last] = a * c2 - q[0] * b2;
    for (int k = 0; k < 3; k++) sums[k] += p[k] * p[k];
    sums[3] += p[0] * p[1];
    sums[4] += p[0] * p[2];
    sums[5] += p[1] * p[2];
    // the major axis of an oblate grain lies at right angles to p: 2 theta turns by pi
    const Real x = p[flow], y = p[gradient], square = x * x + y * y;
    const auto lies = square >= 1e-18;
    sums[7] += pick(lies, sign * (x * x - y * y) / square, Real{});
    sums[8] += pick(lies, sign * 2.0 * x * y / square, Real{});
    sums[9] += pick(lies, 1.0 + Real{}, Real{});
  }
};

}

GRAINSCOPE_CLONES
int NematicSums::alike(int count, const double *semi_axes) { return threes_alike(semi_axes, count); }

GRAINSCOPE_CLONES
void NematicSums::add_alike(int count, const SymmetryAxis &axis, const double *quaternion, const double *omega) {
  const double sign = axis.shape == Shape::oblate ? -1.0 : 1.0;
  Part<Lanes> fours;
  Part<double> ones;
  int i = 0;
  for (; i + LANES <= count; i += LANES) {
    fours.add_spin(omega + 3 * i);
    if (axis.index >= 0) fours.add_axis(quaternion + 4 * i, axis.index, flow_, gradient_, sign);
  }
  for (; i < count; i++) {
    ones.add_spin(omega + 3 * i);
    if (axis.index >= 0) ones.add_axis(quaternion + 4 * i, axis.index, flow_, gradient_, sign);
  }
  for (int k = 0; k < 14; k++) sums[k] += ones.sums[k] + sum_of(fours.sums[k]);
  sums[14] += count;
  if (axis.index < 0) return;
  sums[6] += count;
  if (axis.shape == Shape::oblate) sums[10] += count;
}

/** A line's angle in (-pi/2, pi/2], from one in [-pi, pi]. */
static double within_half_turn(double angle) {
  if (angle > M_PI_2) return angle - M_PI;
  return angle <= -M_PI_2 ? angle + M_PI : angle;
}

double line_angle(double x, double y) { return within_half_turn(std::atan2(y, x)); }

double major_axis_angle(const Eigen::Vector3d &axis, Shape shape) {
  if (axis[0] * axis[0] + axis[1] * axis[1] < 1e-18) return 0.0;
  return shape == Shape::oblate ? line_angle(axis[1], -axis[0]) : line_angle(axis[0], axis[1]);
}

Nematic::Nematic(const NematicSums &all)
    : q(Eigen::Matrix3d::Zero()), eigenvalues(Eigen::Vector3d::Zero()), director(Eigen::Vector3d::Zero()), order(0.0),
      biaxiality(0.0), theta(0.0), director_theta(0.0), spin(Eigen::Vector3d::Zero()), grains_with_axis(all.sums[6]),
      grains_with_theta(all.sums[9]) {
  const auto &s = all.sums;
  if (s[14] > 0.0) spin = Eigen::Vector3d(s[11], s[12], s[13]) / s[14];
  if (grains_with_axis == 0.0) return;
  q = symmetric_tensor(s.data()) / grains_with_axis;
  q.diagonal().array() -= 1.0 / 3.0;

  const PrincipalAxes principal(q);
  eigenvalues = principal.values;
  director = principal.vectors.col(0);
  order = 1.5 * eigenvalues[0];
  biaxiality = eigenvalues[1] - eigenvalues[2];

  const bool mostly_oblate = 2.0 * s[10] > grains_with_axis;
  director_theta = major_axis_angle(all.in_plane(director), mostly_oblate ? Shape::oblate : Shape::prolate);
  if (grains_with_theta > 0.0) theta = within_half_turn(0.5 * std::atan2(s[8], s[7]));
}

}

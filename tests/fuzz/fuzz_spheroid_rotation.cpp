// SPDX-License-Identifier: GPL-2.0-or-later
#include "spheroid_rotation.h"
#include "input.h"
#include <algorithm>

using namespace grainscope;
using fuzz::require;
using fuzz::require_below;

namespace {

double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/** Largest difference of two orientations: q and -q are the same. */
double difference(const double *q, const double *p) {
  double plus = 0.0, minus = 0.0;
  for (int k = 0; k < 4; k++) {
    plus = std::max(plus, std::fabs(q[k] - p[k]));
    minus = std::max(minus, std::fabs(q[k] + p[k]));
  }
  return std::min(plus, minus);
}

void rotate_anything(fuzz::Input &input) {
  double inertia[3], momentum[3], q[4], omega[3];
  for (double &x : inertia) x = input.any();
  for (double &x : momentum) x = input.any();
  for (double &x : q) x = input.any();
  rotate_freely(inertia, momentum, input.any(), q, omega);
  angular_velocity(inertia, momentum, q, omega);
  is_symmetric_top(inertia);
}

}

/** A free top keeps L (given) and its energy; its quaternion stays a unit one; it turns back; two halves of a turn are
 *  one. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzz::Input input(data, size);
  if (input.byte() < 32) {
    rotate_anything(input);
    return 0;
  }
  const double across = input.logarithmic(1e-20, 1e10), along = across * input.logarithmic(0.01, 200.0);
  const int axis = input.whole(0, 2);
  double inertia[3] = {across, across, across}, momentum[3], q[4], omega[3], before[3];
  inertia[axis] = along;
  if (input.flag()) inertia[(axis + 1) % 3] *= 1.0 + 3.9e-9 * input.uniform(-1.0, 1.0);
  require(is_symmetric_top(inertia), "two equal moments make a symmetric top");
  input.direction(momentum, 3);
  const double rate = input.logarithmic(1e-12, 1e6), dt = input.logarithmic(1e-9, 10.0) * (input.flag() ? 1.0 : -1.0);
  for (double &x : momentum) x *= rate * across;
  input.direction(q, 4);

  const double angle = std::fabs(rate * dt) * (1.0 + across / along), rounding = 1e-14 * (1.0 + angle);
  double turned[4], halves[4], back[4];
  std::copy(q, q + 4, turned);
  std::copy(q, q + 4, halves);
  angular_velocity(inertia, momentum, q, before);
  rotate_freely(inertia, momentum, dt, turned, omega);
  require(fuzz::finite(turned, 4) && fuzz::finite(omega, 3), "rotations are finite");
  require_below(std::fabs(turned[0] * turned[0] + dot(turned + 1, turned + 1) - 1.0), 1e-14,
                "a quaternion stays of length 1");
  const double energy = dot(before, momentum), spread = dot(momentum, momentum) / std::min(across, along);
  require_below(std::fabs(dot(omega, momentum) - energy) / spread, 1e-8 + rounding, "a free top keeps its energy");

  std::copy(turned, turned + 4, back);
  rotate_freely(inertia, momentum, -dt, back, omega);
  require_below(difference(back, q), 2.0 * rounding, "a turn back ends where it began");
  for (int half = 0; half < 2; half++) rotate_freely(inertia, momentum, 0.5 * dt, halves, omega);
  require_below(difference(halves, turned), 2.0 * rounding, "two half turns are one");
  return 0;
}

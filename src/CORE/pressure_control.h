// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PRESSURE_CONTROL_H
#define GRAINSCOPE_PRESSURE_CONTROL_H

#include "contact_law.h"
#include <algorithm>
#include <cmath>

namespace grainscope {

/** What the contact network says along one axis, in one evaluation or summed over a window of evaluations. With every
 *  contact moved affinely along the axis n, a change of the box length L gives dP = (stiffness) dL/L + (damping)
 *  (dL/dt)/L, per unit volume:
 *  stiffness = sum (k n_a^2 + k_t (1 - n_a^2)) r_a^2, damping = sum (gamma_n n_a^2 + gamma_t (1 - n_a^2)) r_a^2, k the
 *  tangent normal stiffness, gamma_t that of contacts whose tangential force is not cut. */
struct NetworkResponse {
  double pressure = 0.0;  // sum F_a r_a / volume
  double stiffness = 0.0;
  double damping = 0.0;

  void add(const Contact &c, int axis) {
    const ContactLaw &law = *c.law;
    const double n2 = c.normal[axis] * c.normal[axis], r = c.branch[axis], wr2 = c.weight * r * r;
    const ContactMotion &m = *c.motion;
    pressure += c.weight * c.force[axis] * r;
    stiffness += wr2 * (law.tangent_stiffness(m) * n2 + (law.sticks() ? m.tangential_stiffness * (1.0 - n2) : 0.0));
    damping += wr2 * (m.damping_coefficient * n2 + (m.damped ? m.tangential_damping * (1.0 - n2) : 0.0));
  }
  void add(const NetworkResponse &other, double factor) {
    pressure += factor * other.pressure;
    stiffness += factor * other.stiffness;
    damping += factor * other.damping;
  }
};

/** The controller: at each input dL/dt = kp (P - P_target), held until the next. With the automatic gain kp = beta
 *  L/(eta + K T), T the time between inputs, a network that answers affinely is stable for every beta < 1 (sampled
 *  recursion of the window average and the velocity held before it, by the Jury criterion). 0.5 leaves a factor of two
 *  for what is not affine; smaller values make a dilute start slow. */
struct PressureControl {
  static constexpr double beta = 0.5;

  bool automatic = true;
  double gain = 0.0;           // kp, velocity per pressure, when not automatic
  double limit = 0.01;         // largest |change of L| between two inputs, relative to L
  double max_rate = HUGE_VAL;  // largest |dL/dt| / L

  struct Input {
    double velocity;  // dL/dt
    bool clipped;
  };

  Input input(const NetworkResponse &window, double target, double length, double interval) const {
    const double bound = length * std::min(limit / interval, max_rate);
    const double resistance = window.damping + window.stiffness * interval;
    const double kp = automatic ? beta * length / resistance : gain;
    const double error = window.pressure - target;
    if (error == 0.0) return {0.0, false};
    const double wanted = kp * error;  // infinite where nothing resists: clipped
    return {std::clamp(wanted, -bound, bound), std::fabs(wanted) > bound};
  }
};

/** Counts how often a growing quantity has passed a multiple of its interval, without drift; the first time is at
 *  once. */
class Intervals {
 public:
  explicit Intervals(double interval = 1.0) : interval_(interval) {}

  double interval() const { return interval_; }
  double passed() const { return passed_; }
  double next() const { return next_; }
  void restore(double passed, double next) {
    passed_ = passed;
    next_ = next;
  }

  /** Advances; true if a multiple of the interval was reached or passed. Sums of steps err by ulps: 1e-9 of an interval
   *  is forgiven. */
  bool advance(double step) {
    passed_ += step;
    const double turns = passed_ / interval_ + 1e-9;
    if (turns < next_) return false;
    next_ = std::floor(turns) + 1.0;
    return true;
  }

 private:
  double interval_;
  double passed_ = 0.0;
  double next_ = 0.0;
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PRESSURE_CONTROL_H
#define GRAINSCOPE_PRESSURE_CONTROL_H

#include "contact_stiffness.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace grainscope {

/** The six ways in which a box of edges x, y, z and tilts yz, xz, xy deforms, in the host's order: at unit rate every
 *  branch r takes the velocity r_gradient along the axis `flow`. */
struct BoxMode {
  int flow, gradient;
};
inline constexpr BoxMode box_modes[6] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
inline constexpr int number_of_box_modes = 6;

/** Stress, stiffness and damping of the contact network, in one evaluation or summed over a window of evaluations. If
 *  every contact moved affinely at the rates e_b of the modes b, stresses would fall by
 *      dP_a = sum_b (K_ab de_b + eta_ab d(de_b/dt)),
 *      K_ab = (1/volume) sum d_a . (k n n + k_t (1 - n n)) d_b,   d_a: r_gradient along `flow`, of mode a,
 *  eta likewise with gamma_n and gamma_t, by ContactStiffness. Both matrices are symmetric and, as sums of squares, not
 *  negative. Plain doubles, so that ranks add them up. */
struct NetworkResponse {
  // sum F_flow r_gradient / volume: the pressure along an edge, minus the shear stress of a tilt
  std::array<double, 6> pressure{};
  std::array<double, 21> stiffness{}, damping{};  // upper triangles

  static constexpr int place(int a, int b) { return a < b ? b * (b + 1) / 2 + a : a * (a + 1) / 2 + b; }

  /** Pairs of the modes whose stiffness is wanted. */
  class Pairs {
   public:
    Pairs(const std::vector<int> &modes) {
      for (int a : modes)
        for (int b : modes)
          if (b <= a)
            pairs_.push_back(
                {box_modes[a], box_modes[b], box_modes[a].flow == box_modes[b].flow ? 1.0 : 0.0, place(a, b)});
    }

   private:
    friend struct NetworkResponse;
    friend class NetworkLanes;
    struct Pair {
      BoxMode a, b;
      double same_flow;
      int place;
    };
    std::vector<Pair> pairs_;
  };

  void add(const Contact &c, const Pairs &pairs) {
    const double x = c.weight * c.force[0], y = c.weight * c.force[1], z = c.weight * c.force[2];
    pressure[0] += x * c.branch[0];
    pressure[1] += y * c.branch[1];
    pressure[2] += z * c.branch[2];
    pressure[3] += y * c.branch[2];
    pressure[4] += x * c.branch[2];
    pressure[5] += x * c.branch[1];
    if (pairs.pairs_.empty()) return;
    const ContactStiffness contact(c);
    for (const Pairs::Pair &pair : pairs.pairs_) {
      const double along = c.normal[pair.a.flow] * c.normal[pair.b.flow], across = pair.same_flow - along;
      const double wr2 = c.weight * c.branch[pair.a.gradient] * c.branch[pair.b.gradient];
      stiffness[pair.place] += wr2 * contact.stiffness(along, across);
      damping[pair.place] += wr2 * contact.damping(along, across);
    }
  }
  void add(const NetworkResponse &other, double factor) {
    for (int k = 0; k < 6; k++) pressure[k] += factor * other.pressure[k];
    for (int k = 0; k < 21; k++) {
      stiffness[k] += factor * other.stiffness[k];
      damping[k] += factor * other.damping[k];
    }
  }
  /** eta_ab + K_ab T. */
  double resistance(int a, int b, double interval) const {
    return damping[place(a, b)] + stiffness[place(a, b)] * interval;
  }
};

/** The controller of one stress. At each input the rate of its mode becomes (P - P_target) times a gain, and is held
 *  until the next input. The automatic gain is beta/D with D >= eta + K T, T the time between inputs. For one mode with
 *  an affine response the sampled recursion (window average, and the rate held before it) is stable for every beta < 1,
 *  by the Jury criterion. Several modes at once are stable too if each D_a is the sum over the driven modes b of
 *  |eta_ab + K_ab T|: then D - (eta + K T) is diagonally dominant and not negative, and every eigenvector of the loop
 *  obeys the recursion of one mode, with its values of D^-1/2 K D^-1/2 and D^-1/2 eta D^-1/2, which together are at
 *  most 1. beta = 0.5 leaves a factor of two for the response that is not affine; smaller values make a dilute start
 *  slow. */
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

  /** `error`: P - P_target; `resistance`: D; `length`: L, and 1 where a rate is wanted in place of a velocity. */
  Input input(double error, double resistance, double length, double interval) const {
    return clip(error == 0.0 ? 0.0 : kp(resistance, length) * error, length, interval);
  }

  /** For a mode whose final rate need not be zero: a rate `base` is added to the rate that the error gives. At each
   *  input `base` grows by a tenth of the elastic share K T/D of that rate, slowly compared with the loop; while the
   *  rate is clipped it stays. `elastic`: K T. */
  Input input_with_base(double error, double resistance, double elastic, double length, double interval,
                        double &base) const {
    const double wanted = error == 0.0 ? 0.0 : kp(resistance, length) * error;
    const Input input = clip(base * length + wanted, length, interval);
    if (!input.clipped && elastic > 0.0) base += 0.1 * elastic / resistance * wanted / length;
    return input;
  }

 private:
  double kp(double resistance, double length) const { return automatic ? beta * length / resistance : gain; }
  Input clip(double wanted, double length, double interval) const {  // infinite where nothing resists
    const double bound = length * std::min(limit / interval, max_rate);
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

  /** Advances; true if a multiple of the interval was reached or passed. Sums of steps have rounding errors: 1e-9 of an
   *  interval is tolerated. */
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

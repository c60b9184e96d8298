// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_TANGENTIAL_BOUND_H
#define GRAINSCOPE_TANGENTIAL_BOUND_H

#include <algorithm>
#include <cmath>

namespace grainscope {

/** The tangential force -k_t s - gamma u of a contact whose spring is below the friction limit. The law does not limit
 *  its damping part: in the first evaluation of a run no spring has moved, so none is cut, and gamma u may be any
 *  multiple of the limit. The tangential models of LIGGGHTS take the gamma that acts from here. */
class TangentialBound {
 public:
  /** off: gamma as it is, which costs one branch. watch: the same, and the worst contact is noted. bound: the largest
   *  gamma that keeps the limit. */
  enum class Mode { off, watch, bound };

  static TangentialBound &get() {
    static TangentialBound bound;
    return bound;
  }
  void set(Mode mode) {
    mode_ = mode;
    excess_ = 0.0;
  }
  Mode mode() const { return mode_; }
  /** Since `set`: the largest |F_t| over its limit of those beyond it, infinity where that is 0; 0 when none was. */
  double excess() const { return excess_; }

  /** `f`: the force of the spring; `u`: the tangential velocity. */
  double damping(double gamma, const double f[3], const double u[3], double limit) {
    return mode_ == Mode::off ? gamma : within(gamma, f, u, limit);
  }

  /** The largest g in [0, gamma] with |f - g u| <= limit, for |f| <= limit. */
  static double largest(double gamma, const double f[3], const double u[3], double limit) {
    if (length(gamma, f, u) <= limit) return gamma;
    const double fu = dot(f, u), uu = dot(u, u), room = std::max(0.0, limit * limit - dot(f, f));
    const double root = std::sqrt(fu * fu + uu * room);
    const double g = fu > 0.0 ? (root + fu) / uu : room > 0.0 ? room / (root - fu) : 0.0;  // neither of them cancels
    return std::min(g, gamma);
  }
  static double length(double gamma, const double f[3], const double u[3]) {
    const double sum[3] = {f[0] - gamma * u[0], f[1] - gamma * u[1], f[2] - gamma * u[2]};
    return std::sqrt(dot(sum, sum));
  }

 private:
  Mode mode_ = Mode::off;
  double excess_ = 0.0;

  constexpr TangentialBound() {}
  static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  double within(double gamma, const double f[3], const double u[3], double limit) {
    if (mode_ == Mode::bound) return largest(gamma, f, u, limit);
    const double force = length(gamma, f, u);
    if (force > limit) excess_ = std::max(excess_, force / limit);
    return gamma;
  }
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PAIR_LAW_H
#define GRAINSCOPE_PAIR_LAW_H

#include "lanes.h"
#include <cmath>
#include <vector>

namespace grainscope {

/** The contact laws that are worked out for many contacts side by side: LIGGGHTS's normal models and tangential models
 *  without rolling friction and cohesion, in its own operations and order, so that forces are equal to the last bit. */
struct PairLaw {
  enum class Normal { hertz, hooke, hertz_stiffness, hooke_stiffness };
  enum class Tangential { off, no_history, history };
  Normal normal = Normal::hertz;
  Tangential tangential = Tangential::off;
  bool tangential_damping = true;
  bool limits_force = false;          // a normal force below 0 is set to 0
  bool two_sevenths = false;          // hooke: k_t = 2/7 k_n
  bool absolute_damping = false;      // hooke/stiffness: damping coefficients that are not per mass
  double characteristic_speed = 0.0;  // hooke
  double curvature_limit = 0.0;       // of ellipsoids: the largest effective radius over that of their spheres; 0: none
  double dt = 0.0;
  int kept = 0;  // with `time_level synchronized`, of ellipsoids: the first column of half_step::Kept, behind lambda

  /** What belongs to a pair of atom types. */
  struct alignas(32) Terms {
    // hertz: 2 E*, 8 G*, 4/3 E*, -2 sqrt(5/6) beta; hooke: E*, ln^2 e, ln^2 e + pi^2, 0; others: k_n, k_t, gamma_n,
    // gamma_t
    double constant[4];
    double friction, unused[3];
  };
  int types = 1;
  std::vector<Terms> terms;  // types x types
};

namespace pair_law {

/** A contact before its forces are known, from i's side. */
template <class Real>
struct Approach {
  Real normal[3];              // towards i
  Real overlap, radius, mass;  // radius, mass: effective
  Real normal_velocity, tangential_velocity[3];
};

template <class Real>
struct Coefficients {
  Real constant[4], friction;
};

template <class Real>
struct Normal {
  Real force, kn, kt, gamma_n, gamma_t;
};

template <class Real>
struct Friction {
  Real force[3];
  Real spring[3];         // after the step
  Real uncut[3], length;  // of the spring before it was cut
  typename MaskOf<Real>::type cut;
};

GRAINSCOPE_INLINE double power(double x, double exponent) { return std::pow(x, exponent); }
GRAINSCOPE_INLINE Lanes power(Lanes x, double exponent) {
  Lanes r;
  for (int k = 0; k < LANES; k++) r[k] = std::pow(x[k], exponent);
  return r;
}

template <class Real>
GRAINSCOPE_INLINE Normal<Real> normal_force(const PairLaw &law, const Coefficients<Real> &by, const Approach<Real> &a) {
  Normal<Real> n;
  const Real *c = by.constant;
  switch (law.normal) {
    case PairLaw::Normal::hertz: {
      const Real length = root(a.radius * a.overlap), stiffness = c[0] * length;
      n.kt = c[1] * length;
      n.kn = c[2] * length;
      n.gamma_n = c[3] * root(stiffness * a.mass);
      n.gamma_t = law.tangential_damping ? c[3] * root(n.kt * a.mass) : Real{};
      break;
    }
    case PairLaw::Normal::hooke: {
      const Real size = root(a.radius);
      n.kn = 16. / 15. * size * c[0] *
             power(15. * a.mass * law.characteristic_speed * law.characteristic_speed / (16. * size * c[0]), 0.2);
      n.kt = law.two_sevenths ? n.kn * 0.285714286 : n.kn;
      n.gamma_n = root(4. * a.mass * n.kn * c[1] / c[2]);
      n.gamma_t = law.tangential_damping ? n.gamma_n : Real{};
      break;
    }
    case PairLaw::Normal::hertz_stiffness: {
      const Real length = root(a.radius * a.overlap);
      n.kn = length * c[0];
      n.kt = length * c[1];
      n.gamma_n = length * a.mass * c[2];
      n.gamma_t = law.tangential_damping ? length * a.mass * c[3] : Real{};
      break;
    }
    case PairLaw::Normal::hooke_stiffness:
      n.kn = c[0];
      n.kt = c[1];
      n.gamma_n = law.absolute_damping ? c[2] : a.mass * c[2];
      n.gamma_t = !law.tangential_damping ? Real{} : law.absolute_damping ? c[3] : a.mass * c[3];
  }
  n.force = -n.gamma_n * a.normal_velocity + n.kn * a.overlap;
  if (law.limits_force) n.force = pick(n.force < 0.0, Real{}, n.force);
  return n;
}

template <class Real>
GRAINSCOPE_INLINE Real length_of(const Real *v) {
  return root(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/** `tangential history`; `before`: the spring as the last step left it. */
template <class Real>
GRAINSCOPE_INLINE void spring_friction(const PairLaw &law, Real limit, const Approach<Real> &a, const Normal<Real> &n,
                                       const Real *before, Friction<Real> &f) {
  for (int k = 0; k < 3; k++) f.uncut[k] = before[k] + a.tangential_velocity[k] * law.dt;
  const Real along = f.uncut[0] * a.normal[0] + f.uncut[1] * a.normal[1] + f.uncut[2] * a.normal[2];
  for (int k = 0; k < 3; k++) f.uncut[k] -= along * a.normal[k];
  f.length = length_of(f.uncut);
  const Real elastic = n.kt * f.length;
  f.cut = elastic > limit;
  for (int k = 0; k < 3; k++) {
    f.spring[k] = f.uncut[k];
    f.force[k] = -(n.kt * f.uncut[k]);
  }
  if (any(f.cut)) {
    const Real ratio = limit / elastic;
    for (int k = 0; k < 3; k++) {
      const Real scaled = f.force[k] * ratio;
      f.force[k] = pick(f.cut, scaled, f.force[k] - n.gamma_t * a.tangential_velocity[k]);
      f.spring[k] = pick(f.cut, -scaled / n.kt, f.spring[k]);
    }
  } else {
    for (int k = 0; k < 3; k++) f.force[k] -= n.gamma_t * a.tangential_velocity[k];
  }
}

/** `tangential no_history`. */
template <class Real>
GRAINSCOPE_INLINE void viscous_friction(Real limit, const Approach<Real> &a, const Normal<Real> &n, Friction<Real> &f) {
  f.length = length_of(a.tangential_velocity);
  f.cut = limit < n.gamma_t * f.length;
  const Real gamma = pick(f.cut, limit / f.length, n.gamma_t);
  for (int k = 0; k < 3; k++) f.force[k] = -gamma * a.tangential_velocity[k];
}

}

}

#endif

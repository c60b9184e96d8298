// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SPHEROID_PAIR_H
#define GRAINSCOPE_SPHEROID_PAIR_H

#include "lanes.h"

/** What the solver of ellipsoid_contact.cpp asks of a pair of bodies: p = C^-1 d at a lambda, how p changes with
 *  lambda, and what follows. */
namespace grainscope { namespace contact_solver {

template <class Real>
GRAINSCOPE_INLINE Real dot(const Real *a, const Real *b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/** |v - (u.v) u|^2: not v.v - (u.v)^2, which cancels. */
template <class Real>
GRAINSCOPE_INLINE Real across(const Real *v, const Real *u, Real along) {
  const Real a = v[0] - along * u[0], b = v[1] - along * u[1], c = v[2] - along * u[2];
  return a * a + b * b + c * c;
}

/** A spheroid, or several side by side. */
template <class Real>
struct SpheroidOf {
  Real u[3], equatorial_square, polar_square, inverse_equatorial_square, inverse_polar_square, inverse_product;
};

template <class Real>
GRAINSCOPE_INLINE Real support(const SpheroidOf<Real> &body, const Real *n) {
  const Real along = dot(body.u, n);
  return body.equatorial_square * across(n, body.u, along) + body.polar_square * along * along;
}

/** p = C^-1 d of two spheroids, in closed form: only the components of p along the two axes are unknown. */
template <class Real_>
class SpheroidPair {
 public:
  using Real = Real_;
  using Body = SpheroidOf<Real>;

  /** p and what follows from it. t1, t2 are the components along the axes as they come out of the solution, to all
   *  digits; those that the supports are made of are from p as it was rounded: d.p / (a + b) hardly changes with p near
   *  its largest, but only for one and the same p. */
  struct State {
    Real p[3], t1, t2, support1, support2;  // supports: p.B1 p, p.B2 p
    Real along1, along2, across1, across2;  // components along the axes, squares of those across them
  };

  GRAINSCOPE_INLINE SpheroidPair(const Body &one, const Body &two, const Real *d)
      : one_(one), two_(two), excess1_(one.polar_square - one.equatorial_square),
        excess2_(two.polar_square - two.equatorial_square), d1_(dot(one.u, d)), d2_(dot(two.u, d)),
        c_(dot(one.u, two.u)), s2_(across(one.u, two.u, c_)) {
    for (int k = 0; k < 3; k++) d_[k] = d[k];
  }

  GRAINSCOPE_INLINE void evaluate(Real lambda, State &s) {
    const Real m = 1.0 - lambda;
    e_ = m * one_.equatorial_square + lambda * two_.equatorial_square;
    alpha1_ = m * excess1_;
    alpha2_ = lambda * excess2_;
    const Real det = e_ * (m * one_.polar_square + lambda * two_.polar_square) + alpha1_ * alpha2_ * s2_;
    const Real both = 1.0 / (e_ * det);
    inverse_e_ = det * both;
    inverse_det_ = e_ * both;
    along_axes(d1_, d2_, s.t1, s.t2);
    const Real f1 = alpha1_ * s.t1, f2 = alpha2_ * s.t2;
    for (int k = 0; k < 3; k++) s.p[k] = (d_[k] - f1 * one_.u[k] - f2 * two_.u[k]) * inverse_e_;
    follow(s);
  }

  /** w = dp/dlambda = C^-1 (B1 - B2) p, as p.B1 w and p.B2 w. */
  GRAINSCOPE_INLINE void differentiate(const State &s, Real &product1, Real &product2) {
    difference(s.t1, s.t2, y1_, y2_);
    const Real f1 = excess1_ * s.t1 - alpha1_ * y1_, f2 = excess2_ * s.t2 + alpha2_ * y2_;
    pw_ = (s.support1 - s.support2 - alpha1_ * y1_ * s.t1 - alpha2_ * y2_ * s.t2) * inverse_e_;
    f1_ = f1 * inverse_e_;
    f2_ = f2 * inverse_e_;
    product1 = one_.equatorial_square * pw_ + excess1_ * s.t1 * y1_;
    product2 = two_.equatorial_square * pw_ + excess2_ * s.t2 * y2_;
  }

  /** Half the second derivatives of the supports: w.B1 w + 2 p.B1 v with v = C^-1 (B1 - B2) w, likewise B2. After
   *  differentiate(). */
  GRAINSCOPE_INLINE void differentiate_again(const State &s, Real &product1, Real &product2) {
    difference(y1_, y2_, z1_, z2_);
    f0_ = (one_.equatorial_square - two_.equatorial_square) * inverse_e_;
    g1_ = (excess1_ * y1_ - alpha1_ * z1_) * inverse_e_;
    g2_ = (excess2_ * y2_ + alpha2_ * z2_) * inverse_e_;
    const Real ww = f0_ * pw_ + f1_ * y1_ - f2_ * y2_, pv = f0_ * pw_ + g1_ * s.t1 - g2_ * s.t2, both = ww + 2.0 * pv;
    product1 = one_.equatorial_square * both + excess1_ * (y1_ * y1_ + 2.0 * s.t1 * z1_);
    product2 = two_.equatorial_square * both + excess2_ * (y2_ * y2_ + 2.0 * s.t2 * z2_);
  }

  /** The state with p moved by step w + step^2 v; after differentiate_again(). */
  GRAINSCOPE_INLINE void advance(const State &s, Real step, State &moved) const {
    for (int k = 0; k < 3; k++) {
      const Real w = f0_ * s.p[k] + f1_ * one_.u[k] - f2_ * two_.u[k], v = f0_ * w + g1_ * one_.u[k] - g2_ * two_.u[k];
      moved.p[k] = s.p[k] + step * (w + step * v);
    }
    moved.t1 = s.t1 + step * (y1_ + step * z1_);
    moved.t2 = s.t2 + step * (y2_ + step * z2_);
    follow(moved);
  }

  /** Contact point from the centre of 1. */
  GRAINSCOPE_INLINE void point(const State &s, Real m, Real *x) const {
    const Real f = m * one_.equatorial_square, g = m * excess1_ * s.t1;
    for (int k = 0; k < 3; k++) x[k] = f * s.p[k] + g * one_.u[k];
  }

  /** From a point where B^-1 x = share p, along p/|p| to the surface of 1 (or 2: against it), and the root of the
   *  Gaussian curvature there, 1/(sqrt(det B) g.g) with g = B^-1 y. `inside` is -G at the point. The quadratic's root
   *  is in the form that does not cancel. */
  GRAINSCOPE_INLINE void surface(const State &s, int which, Real share, Real inside, Real length, Real inverse_length,
                                 Real &depth, Real &curvature) const {
    const Body &body = which ? two_ : one_;
    const Real t = which ? s.along2 : s.along1, t2 = t * t, a = which ? s.across2 : s.across1, shared = share * length;
    const Real inverse =
        (a * body.inverse_equatorial_square + t2 * body.inverse_polar_square) * inverse_length * inverse_length;
    depth = inside / (shared + root(shared * shared + inside * inverse));
    const Real scaled = depth * inverse_length;
    const Real ge = share + scaled * body.inverse_equatorial_square, ga = share + scaled * body.inverse_polar_square;
    curvature = body.inverse_product / (a * ge * ge + t2 * ga * ga);
  }

 private:
  /** The components along the axes of C^-1 r, from those of r. */
  GRAINSCOPE_INLINE void along_axes(Real r1, Real r2, Real &y1, Real &y2) const {
    y1 = (e_ * r1 + alpha2_ * (r1 - c_ * r2)) * inverse_det_;
    y2 = (e_ * r2 + alpha1_ * (r2 - c_ * r1)) * inverse_det_;
  }

  /** The components along the axes of C^-1 (B1 - B2) p, from those of p. */
  GRAINSCOPE_INLINE void difference(Real t1, Real t2, Real &y1, Real &y2) const {
    along_axes((one_.polar_square - two_.equatorial_square) * t1 - excess2_ * c_ * t2,
               excess1_ * c_ * t1 + (one_.equatorial_square - two_.polar_square) * t2, y1, y2);
  }

  GRAINSCOPE_INLINE void follow(State &s) const {
    s.along1 = dot(one_.u, s.p);
    s.along2 = dot(two_.u, s.p);
    s.across1 = across(s.p, one_.u, s.along1);
    s.across2 = across(s.p, two_.u, s.along2);
    s.support1 = one_.equatorial_square * s.across1 + one_.polar_square * s.along1 * s.along1;
    s.support2 = two_.equatorial_square * s.across2 + two_.polar_square * s.along2 * s.along2;
  }

  const Body &one_, &two_;
  Real d_[3], excess1_, excess2_, d1_, d2_, c_, s2_;
  Real e_, alpha1_, alpha2_, inverse_e_, inverse_det_;
  Real y1_, y2_, z1_, z2_, pw_, f0_, f1_, f2_, g1_, g2_;  // y, z: components of w and v along the axes; pw: p.w
};

/** The state of the lanes that are `settled`: a struct of nothing but Reals. */
template <class State>
GRAINSCOPE_INLINE void keep(bool settled, const State &moved, State &kept) {
  if (settled) kept = moved;
}
template <class State>
GRAINSCOPE_INLINE void keep(LaneMask settled, const State &moved, State &kept) {
  for (int k = 0; k < 3; k++) kept.p[k] = pick(settled, moved.p[k], kept.p[k]);
  kept.support1 = pick(settled, moved.support1, kept.support1);
  kept.support2 = pick(settled, moved.support2, kept.support2);
  kept.t1 = pick(settled, moved.t1, kept.t1);
  kept.t2 = pick(settled, moved.t2, kept.t2);
  kept.along1 = pick(settled, moved.along1, kept.along1);
  kept.along2 = pick(settled, moved.along2, kept.along2);
  kept.across1 = pick(settled, moved.across1, kept.across1);
  kept.across2 = pick(settled, moved.across2, kept.across2);
}

}}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_TRIAXIAL_PAIR_H
#define GRAINSCOPE_TRIAXIAL_PAIR_H

#include "ellipsoid_contact.h"
#include "spheroid_pair.h"
#include "symmetric_tensor.h"

namespace grainscope { namespace contact_solver {

inline double support(const Triaxial &body, const double *n) {
  double sum = 0.0;
  for (int k = 0; k < 3; k++) sum += body.square[k] * dot(body.axis[k], n) * dot(body.axis[k], n);
  return sum;
}

/** The same of any two ellipsoids: C by components, factorised as L D L^T. */
class TriaxialPair {
 public:
  using Real = double;
  using Body = Triaxial;

  TriaxialPair(const Triaxial &one, const Triaxial &two, const double *d) : one_(one), two_(two), d_(d) {
    matrix(one, b1_);
    matrix(two, b2_);
  }

  struct State {
    double p[3], support1, support2;
    double t1[3], t2[3];  // components of p along the axes
  };

  void evaluate(double lambda, State &s) {
    const double m = 1.0 - lambda;
    double c[6];
    for (int k = 0; k < 6; k++) c[k] = m * b1_[k] + lambda * b2_[k];
    l10_ = c[3] / c[0];
    l20_ = c[4] / c[0];
    const double d1 = c[1] - l10_ * c[3], off = c[5] - l10_ * c[4];
    l21_ = off / d1;
    pivot_[0] = c[0];
    pivot_[1] = d1;
    pivot_[2] = c[2] - l20_ * c[4] - l21_ * off;
    solve(d_, s.p);
    follow(s);
  }

  void differentiate(const State &s, double &product1, double &product2) {
    times(one_, s.t1, b1p_);
    times(two_, s.t2, b2p_);
    difference(b1p_, b2p_, w_);
    product1 = dot(b1p_, w_);
    product2 = dot(b2p_, w_);
  }

  void differentiate_again(const State &, double &product1, double &product2) {
    double t1[3], t2[3], b1w[3], b2w[3];
    for (int k = 0; k < 3; k++) {
      t1[k] = dot(one_.axis[k], w_);
      t2[k] = dot(two_.axis[k], w_);
    }
    times(one_, t1, b1w);
    times(two_, t2, b2w);
    difference(b1w, b2w, v_);
    product1 = dot(b1w, w_) + 2.0 * dot(b1p_, v_);
    product2 = dot(b2w, w_) + 2.0 * dot(b2p_, v_);
  }

  void advance(const State &s, double step, State &moved) const {
    for (int k = 0; k < 3; k++) moved.p[k] = s.p[k] + step * (w_[k] + step * v_[k]);
    follow(moved);
  }

  void point(const State &s, double m, double *x) const {
    times(one_, s.t1, x);
    for (int k = 0; k < 3; k++) x[k] *= m;
  }

  void surface(const State &s, int which, double share, double inside, double length, double inverse_length,
               double &depth, double &curvature) const {
    const Triaxial &body = which ? two_ : one_;
    const double *t = which ? s.t2 : s.t1, shared = share * length;
    double inverse = 0.0;
    for (int k = 0; k < 3; k++) inverse += t[k] * t[k] / body.square[k];
    depth = inside / (shared + root(shared * shared + inside * inverse * inverse_length * inverse_length));
    double g2 = 0.0;
    for (int k = 0; k < 3; k++) {
      const double g = t[k] * (share + depth * inverse_length / body.square[k]);
      g2 += g * g;
    }
    curvature = 1.0 / (root(body.square[0] * body.square[1] * body.square[2]) * g2);
  }

 private:
  static void matrix(const Triaxial &body, double *b) {
    for (int k = 0; k < 6; k++) b[k] = 0.0;
    for (int k = 0; k < 3; k++) {
      const double *a = body.axis[k], s = body.square[k], sa[3] = {s * a[0], s * a[1], s * a[2]};
      add_components(b, dyad(sa, a));
    }
  }

  static void times(const Triaxial &body, const double *t, double *bp) {
    for (int i = 0; i < 3; i++) {
      bp[i] = 0.0;
      for (int k = 0; k < 3; k++) bp[i] += body.square[k] * t[k] * body.axis[k][i];
    }
  }

  void solve(const double *r, double *w) const {
    const double y1 = r[1] - l10_ * r[0], y2 = r[2] - l20_ * r[0] - l21_ * y1;
    w[2] = y2 / pivot_[2];
    w[1] = y1 / pivot_[1] - l21_ * w[2];
    w[0] = r[0] / pivot_[0] - l10_ * w[1] - l20_ * w[2];
  }

  void difference(const double *b1, const double *b2, double *w) const {
    const double r[3] = {b1[0] - b2[0], b1[1] - b2[1], b1[2] - b2[2]};
    solve(r, w);
  }

  void follow(State &s) const {
    s.support1 = s.support2 = 0.0;
    for (int k = 0; k < 3; k++) {
      s.t1[k] = dot(one_.axis[k], s.p);
      s.t2[k] = dot(two_.axis[k], s.p);
      s.support1 += one_.square[k] * s.t1[k] * s.t1[k];
      s.support2 += two_.square[k] * s.t2[k] * s.t2[k];
    }
  }

  const Triaxial &one_, &two_;
  const double *d_;
  double b1_[6], b2_[6];  // xx yy zz xy xz yz
  double l10_, l20_, l21_, pivot_[3], b1p_[3], b2p_[3], w_[3], v_[3];
};

}}

#endif

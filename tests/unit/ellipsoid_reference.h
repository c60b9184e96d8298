// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ELLIPSOID_REFERENCE_H
#define GRAINSCOPE_ELLIPSOID_REFERENCE_H

#include <cmath>

/** Contact of two ellipsoids in quadruple precision, by another way than the kernel's: matrices in the laboratory's
 *  axes, Cramer's rule, and the derivative of the contact function F = lambda (1 - lambda) d.C^-1 d, which falls from
 *  positive to negative, by bisection. */
namespace reference {

#ifdef __SIZEOF_FLOAT128__
using Quad = __float128;
#else
using Quad = long double;  // as wide on most machines without the former
#endif

inline Quad root(Quad x) {
  if (!(x > 0)) return 0;
  Quad y = std::sqrt(static_cast<double>(x));
  for (int k = 0; k < 2; k++) y = (y + x / y) / 2;
  return y;
}

template <class A, class B>
Quad dot(const A *a, const B *b) {
  return static_cast<Quad>(a[0]) * b[0] + static_cast<Quad>(a[1]) * b[1] + static_cast<Quad>(a[2]) * b[2];
}

inline void cross(const Quad *a, const Quad *b, Quad *c) {
  for (int k = 0; k < 3; k++) c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

inline void normalise(Quad *a) {
  const Quad length = root(dot(a, a));
  for (int k = 0; k < 3; k++) a[k] /= length;
}

/** Principal axes, one per row, and semi-axes. */
struct Body {
  Quad axis[3][3];
  Quad semi[3];

  Body(const double semi_axes[3], const double quaternion[4]) {
    Quad q[4], square = 0;
    for (int k = 0; k < 4; k++) square += static_cast<Quad>(quaternion[k]) * quaternion[k];
    const Quad length = root(square);
    for (int k = 0; k < 4; k++) q[k] = quaternion[k] / length;
    const Quad w = q[0], x = q[1], y = q[2], z = q[3];
    const Quad r[3][3] = {{w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)},
                          {2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)},
                          {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z}};
    for (int i = 0; i < 3; i++) {
      semi[i] = semi_axes[i];
      for (int k = 0; k < 3; k++) axis[i][k] = r[i][k];
    }
  }

  /** G = x.B^-1 x - 1 at x from the centre, and half its gradient. */
  Quad shape(const Quad *x, Quad *gradient) const {
    Quad sum = -1;
    for (int k = 0; k < 3; k++) gradient[k] = 0;
    for (int i = 0; i < 3; i++) {
      const Quad t = dot(axis[i], x) / semi[i];
      sum += t * t;
      for (int k = 0; k < 3; k++) gradient[k] += t / semi[i] * axis[i][k];
    }
    return sum;
  }

  /** Distance from a point inside (or on the surface) along the unit vector n to the surface. */
  Quad depth(const Quad *x, const Quad *n) const {
    Quad vv = 0, yv = 0, yy = -1;
    for (int i = 0; i < 3; i++) {
      const Quad y = dot(axis[i], x) / semi[i], v = dot(axis[i], n) / semi[i];
      vv += v * v;
      yv += y * v;
      yy += y * y;
    }
    return (root(yv * yv - vv * yy) - yv) / vv;
  }

  /** Largest x.n over the body, and where. */
  Quad support(const Quad *n, Quad *at) const {
    Quad square = 0;
    for (int i = 0; i < 3; i++) square += semi[i] * semi[i] * dot(axis[i], n) * dot(axis[i], n);
    const Quad h = root(square);
    for (int k = 0; k < 3; k++) at[k] = 0;
    for (int i = 0; i < 3; i++)
      for (int k = 0; k < 3; k++) at[k] += semi[i] * semi[i] * dot(axis[i], n) * axis[i][k] / h;
    return h;
  }
};

/** Gaussian and mean curvature from the fundamental forms of S w(u, v), where w runs over the unit sphere from y/s
 *  along great circles. */
inline void curvatures(const Body &body, const Quad *y, Quad &gaussian, Quad &mean) {
  Quad w[3], e[2][3], r[2][3], n[3];
  for (int i = 0; i < 3; i++) w[i] = dot(body.axis[i], y) / body.semi[i];
  normalise(w);
  int least = 0;
  for (int k = 1; k < 3; k++)
    if (w[k] * w[k] < w[least] * w[least]) least = k;
  const Quad unit[3] = {Quad(least == 0), Quad(least == 1), Quad(least == 2)};
  cross(w, unit, e[0]);
  normalise(e[0]);
  cross(w, e[0], e[1]);
  for (int j = 0; j < 2; j++)
    for (int i = 0; i < 3; i++) r[j][i] = body.semi[i] * e[j][i];
  cross(r[0], r[1], n);
  normalise(n);
  Quad second[3];
  for (int i = 0; i < 3; i++) second[i] = -body.semi[i] * w[i];
  const Quad E = dot(r[0], r[0]), F = dot(r[0], r[1]), G = dot(r[1], r[1]), L = dot(second, n);  // M = 0, N = L
  gaussian = L * L / (E * G - F * F);
  mean = L * (E + G) / (2 * (E * G - F * F));
  if (mean < 0) mean = -mean;
}

/** F'(lambda) of one pair. */
template <class Real>
class Derivative {
 public:
  Derivative(const Body &one, const Body &two, const double *d) {
    for (int i = 0; i < 3; i++) {
      d_[i] = d[i];
      for (int j = 0; j <= i; j++) {
        Quad b1 = 0, b2 = 0;
        for (int k = 0; k < 3; k++) {
          b1 += one.semi[k] * one.semi[k] * one.axis[k][i] * one.axis[k][j];
          b2 += two.semi[k] * two.semi[k] * two.axis[k][i] * two.axis[k][j];
        }
        b1_[i][j] = b1_[j][i] = static_cast<Real>(b1);
        b2_[i][j] = b2_[j][i] = static_cast<Real>(b2);
      }
    }
  }

  Real at(Real lambda) {
    Real c[3][3], s1 = 0, s2 = 0;
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) c[i][j] = (1 - lambda) * b1_[i][j] + lambda * b2_[i][j];
    const Real a00 = c[1][1] * c[2][2] - c[1][2] * c[1][2], a01 = c[0][2] * c[1][2] - c[0][1] * c[2][2];
    const Real a02 = c[0][1] * c[1][2] - c[0][2] * c[1][1], a11 = c[0][0] * c[2][2] - c[0][2] * c[0][2];
    const Real a12 = c[0][1] * c[0][2] - c[0][0] * c[1][2], a22 = c[0][0] * c[1][1] - c[0][1] * c[0][1];
    const Real det = c[0][0] * a00 + c[0][1] * a01 + c[0][2] * a02;
    p[0] = (a00 * d_[0] + a01 * d_[1] + a02 * d_[2]) / det;
    p[1] = (a01 * d_[0] + a11 * d_[1] + a12 * d_[2]) / det;
    p[2] = (a02 * d_[0] + a12 * d_[1] + a22 * d_[2]) / det;
    for (int i = 0; i < 3; i++) {
      b1p[i] = b1_[i][0] * p[0] + b1_[i][1] * p[1] + b1_[i][2] * p[2];
      s1 += b1p[i] * p[i];
      s2 += (b2_[i][0] * p[0] + b2_[i][1] * p[1] + b2_[i][2] * p[2]) * p[i];
    }
    const Real dp = d_[0] * p[0] + d_[1] * p[1] + d_[2] * p[2];
    contact = lambda * (1 - lambda) * dp;
    return (1 - 2 * lambda) * dp + lambda * (1 - lambda) * (s1 - s2);
  }

  Real p[3], b1p[3], contact;

 private:
  Real b1_[3][3], b2_[3][3], d_[3];
};

struct Contact {
  Quad lambda;
  Quad contact;  // F at its largest: below 1 where the ellipsoids overlap; (|d| / |d| at tangency)^2
  Quad normal[3], point[3], depth[2];
  bool proved;  // F' changes its sign within 1e-24 of lambda
};

/** Lambda by bisection, to about ten digits. */
inline double rough_lambda(const Body &one, const Body &two, const double d[3]) {
  Derivative<double> slope(one, two, d);
  double low = 0.0, high = 1.0;
  for (int k = 0; k < 45; k++) {
    const double middle = 0.5 * (low + high);
    (slope.at(middle) > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/** sqrt(F): how many times their size the ellipsoids must be to be tangent. F hardly changes near its largest. */
inline Quad scale_of_tangency(const Body &one, const Body &two, const double d[3]) {
  Derivative<Quad> slope(one, two, d);
  slope.at(rough_lambda(one, two, d));
  return root(slope.contact);
}

inline Contact solve(const Body &one, const Body &two, const double d[3]) {
  Derivative<Quad> slope(one, two, d);
  const auto end = [](Quad lambda) { return lambda < Quad(0.5) ? lambda : 1 - lambda; };
  Quad lambda = rough_lambda(one, two, d), before = lambda + Quad(1e-10) * end(lambda), f = slope.at(lambda),
       f_before = slope.at(before);
  for (int k = 0; k < 8 && f != 0 && f != f_before; k++) {  // secants
    const Quad next = lambda - f * (lambda - before) / (f - f_before), moved = (next - lambda) / end(lambda);
    before = lambda;
    f_before = f;
    lambda = next;
    if (moved * moved < Quad(1e-32)) break;
    f = slope.at(lambda);
  }
  Contact c;
  const Quad width = Quad(1e-24) * end(lambda);
  c.lambda = lambda;
  c.proved = slope.at(lambda - width) > 0 && slope.at(lambda + width) < 0;
  slope.at(lambda);
  c.contact = slope.contact;
  Quad back[3], from_two[3];
  for (int k = 0; k < 3; k++) {
    c.point[k] = (1 - lambda) * slope.b1p[k];
    from_two[k] = c.point[k] - d[k];
  }
  one.shape(c.point, c.normal);
  normalise(c.normal);
  for (int k = 0; k < 3; k++) back[k] = -c.normal[k];
  c.depth[0] = one.depth(c.point, c.normal);
  c.depth[1] = two.depth(from_two, back);
  return c;
}

}

#endif

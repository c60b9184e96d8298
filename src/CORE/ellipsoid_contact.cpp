// SPDX-License-Identifier: GPL-2.0-or-later
#include "ellipsoid_contact.h"
#include "symmetry_axis.h"
#include <algorithm>
#include <cmath>

namespace grainscope {

namespace {

inline double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/** p = C^-1 d of two spheroids, in closed form: only the components of p along the two axes are unknown. */
class SpheroidPair {
 public:
  SpheroidPair(const Spheroid &one, const Spheroid &two, const double *d)
      : one_(one), two_(two), d_(d), excess1_(one.polar - one.equatorial), excess2_(two.polar - two.equatorial), d1_(dot(one.u, d)),
        d2_(dot(two.u, d)), c_(dot(one.u, two.u)) {
    const double cross[3] = {one.u[1] * two.u[2] - one.u[2] * two.u[1], one.u[2] * two.u[0] - one.u[0] * two.u[2],
                             one.u[0] * two.u[1] - one.u[1] * two.u[0]};
    s2_ = dot(cross, cross);
  }

  /** p and its supports p.B1 p and p.B2 p, at lambda. */
  void evaluate(double lambda) {
    const double m = 1.0 - lambda;
    e_ = m * one_.equatorial + lambda * two_.equatorial;
    alpha1_ = m * excess1_;
    alpha2_ = lambda * excess2_;
    inverse_e_ = 1.0 / e_;
    inverse_det_ = 1.0 / (e_ * (m * one_.polar + lambda * two_.polar) + alpha1_ * alpha2_ * s2_);
    solve(d_, d1_, d2_, p, t1_, t2_);
    supports();
  }

  /** dp/dlambda, as p.B1 p' and p.B2 p'. */
  void differentiate(double &along1, double &along2) {
    const double r1 = (one_.polar - two_.equatorial) * t1_ - excess2_ * c_ * t2_;
    const double r2 = excess1_ * c_ * t1_ + (one_.equatorial - two_.polar) * t2_;
    y1_ = (e_ * r1 + alpha2_ * (r1 - c_ * r2)) * inverse_det_;
    y2_ = (e_ * r2 + alpha1_ * (r2 - c_ * r1)) * inverse_det_;
    const double pw = (support1 - support2 - alpha1_ * y1_ * t1_ - alpha2_ * y2_ * t2_) * inverse_e_;
    along1 = one_.equatorial * pw + excess1_ * t1_ * y1_;
    along2 = two_.equatorial * pw + excess2_ * t2_ * y2_;
  }

  /** Moves p by dp/dlambda times `step`; after differentiate(). */
  void advance(double step) {
    const double difference = one_.equatorial - two_.equatorial;
    const double f1 = excess1_ * t1_ - alpha1_ * y1_, f2 = excess2_ * t2_ + alpha2_ * y2_;
    for (int k = 0; k < 3; k++) p[k] += step * inverse_e_ * (difference * p[k] + f1 * one_.u[k] - f2 * two_.u[k]);
    t1_ += step * y1_;
    t2_ += step * y2_;
    supports();
  }

  /** B1 p, and p.B1^-1 p and p.B2^-1 p. */
  void finish(double *b1p, double &inverse1, double &inverse2) const {
    for (int k = 0; k < 3; k++) b1p[k] = one_.equatorial * p[k] + excess1_ * t1_ * one_.u[k];
    inverse1 = across1_ / one_.equatorial + along1_ * along1_ / one_.polar;
    inverse2 = across2_ / two_.equatorial + along2_ * along2_ / two_.polar;
  }

  double p[3], support1, support2;

 private:
  /** w = C^-1 r, where r1 and r2 are the components of r along the axes, t1 and t2 those of w. */
  void solve(const double *r, double r1, double r2, double *w, double &t1, double &t2) const {
    t1 = (e_ * r1 + alpha2_ * (r1 - c_ * r2)) * inverse_det_;
    t2 = (e_ * r2 + alpha1_ * (r2 - c_ * r1)) * inverse_det_;
    for (int k = 0; k < 3; k++) w[k] = (r[k] - alpha1_ * t1 * one_.u[k] - alpha2_ * t2 * two_.u[k]) * inverse_e_;
  }

  /** From the components along and across each axis, all positive: thin discs lose no digits. All of them from p as rounded, not from
   *  t1_ and t2_: d.p / (a + b) hardly changes with p near its largest, but only for one and the same p. */
  void supports() {
    along1_ = dot(one_.u, p);
    along2_ = dot(two_.u, p);
    double across[2] = {0.0, 0.0};
    for (int k = 0; k < 3; k++) {
      const double a = p[k] - along1_ * one_.u[k], b = p[k] - along2_ * two_.u[k];
      across[0] += a * a;
      across[1] += b * b;
    }
    across1_ = across[0];
    across2_ = across[1];
    support1 = one_.equatorial * across1_ + one_.polar * along1_ * along1_;
    support2 = two_.equatorial * across2_ + two_.polar * along2_ * along2_;
  }

  const Spheroid &one_, &two_;
  const double *d_;
  double excess1_, excess2_, d1_, d2_, c_, s2_;
  double e_, alpha1_, alpha2_, inverse_e_, inverse_det_;
  double t1_, t2_, y1_, y2_, along1_, along2_, across1_, across2_;
};

/** The same of any two ellipsoids: C by components, factorised as L D L^T. */
class TriaxialPair {
 public:
  TriaxialPair(const Triaxial &one, const Triaxial &two, const double *d) : one_(one), two_(two), d_(d) {
    matrix(one, b1_);
    matrix(two, b2_);
  }

  void evaluate(double lambda) {
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
    solve(d_, p);
    supports();
  }

  void differentiate(double &along1, double &along2) {
    double b1p[3], b2p[3], r[3];
    times(one_, t1_, b1p);
    times(two_, t2_, b2p);
    for (int k = 0; k < 3; k++) r[k] = b1p[k] - b2p[k];
    solve(r, w_);
    along1 = dot(b1p, w_);
    along2 = dot(b2p, w_);
  }

  void advance(double step) {
    for (int k = 0; k < 3; k++) p[k] += step * w_[k];
    supports();
  }

  void finish(double *b1p, double &inverse1, double &inverse2) const {
    times(one_, t1_, b1p);
    inverse1 = inverse2 = 0.0;
    for (int k = 0; k < 3; k++) {
      inverse1 += t1_[k] * t1_[k] / one_.square[k];
      inverse2 += t2_[k] * t2_[k] / two_.square[k];
    }
  }

  double p[3], support1, support2;

 private:
  static void matrix(const Triaxial &body, double *b) {
    for (int k = 0; k < 6; k++) b[k] = 0.0;
    for (int k = 0; k < 3; k++) {
      const double *a = body.axis[k], s = body.square[k];
      b[0] += s * a[0] * a[0];
      b[1] += s * a[1] * a[1];
      b[2] += s * a[2] * a[2];
      b[3] += s * a[0] * a[1];
      b[4] += s * a[0] * a[2];
      b[5] += s * a[1] * a[2];
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

  void supports() {
    support1 = support2 = 0.0;
    for (int k = 0; k < 3; k++) {
      t1_[k] = dot(one_.axis[k], p);
      t2_[k] = dot(two_.axis[k], p);
      support1 += one_.square[k] * t1_[k] * t1_[k];
      support2 += two_.square[k] * t2_[k] * t2_[k];
    }
  }

  const Triaxial &one_, &two_;
  const double *d_;
  double b1_[6], b2_[6];  // xx yy zz xy xz yz
  double l10_, l20_, l21_, pivot_[3], t1_[3], t2_[3], w_[3];
};

using std::sqrt;

/** n.B n */
inline double support(const Spheroid &body, const double *n) {
  const double t = dot(body.u, n);
  double across = 0.0;
  for (int k = 0; k < 3; k++) across += (n[k] - t * body.u[k]) * (n[k] - t * body.u[k]);
  return body.equatorial * across + body.polar * t * t;
}

inline double support(const Triaxial &body, const double *n) {
  double sum = 0.0;
  for (int k = 0; k < 3; k++) sum += body.square[k] * dot(body.axis[k], n) * dot(body.axis[k], n);
  return sum;
}

inline double smallest_square(const Spheroid &body) { return std::min(body.equatorial, body.polar); }
inline double smallest_square(const Triaxial &body) { return *std::min_element(body.square, body.square + 3); }

/** Unit vector along a shortest semi-axis. */
inline void shortest_axis(const Spheroid &body, double *n) {
  if (body.polar <= body.equatorial) {
    for (int k = 0; k < 3; k++) n[k] = body.u[k];
    return;
  }
  int least = 0;  // across the axis: the coordinate axis that is farthest from it, made perpendicular
  for (int k = 1; k < 3; k++)
    if (std::fabs(body.u[k]) < std::fabs(body.u[least])) least = k;
  const double length = sqrt(1.0 - body.u[least] * body.u[least]);
  for (int k = 0; k < 3; k++) n[k] = ((k == least) - body.u[least] * body.u[k]) / length;
}

inline void shortest_axis(const Triaxial &body, double *n) {
  const int least = static_cast<int>(std::min_element(body.square, body.square + 3) - body.square);
  for (int k = 0; k < 3; k++) n[k] = body.axis[least][k];
}

/** Distance from the contact point along p/|p| to a surface: the positive root of a quadratic, in a form that does not cancel.
 *  `inside` is -G at the point, `share` the m |p| of 1 or lambda |p| of 2, `inverse` p.B^-1 p. */
inline double depth_along(double inside, double share, double inverse, double p2) {
  return inside / (share + sqrt(share * share + inside * inverse / p2));
}

inline bool is_sphere(const Spheroid &body) { return body.polar == body.equatorial; }

inline EllipsoidContact sphere_contact(double radius1, double radius2, const double *d, double r) {
  EllipsoidContact c{};
  const double sum = radius1 + radius2;
  c.lambda = radius1 / sum;
  c.touching = r < sum;
  if (!c.touching) {
    c.gap = r - sum;
    return c;
  }
  const double inside = (sum - r) / sum;
  for (int k = 0; k < 3; k++) {
    c.normal[k] = d[k] / r;
    c.point[k] = c.lambda * d[k];
  }
  c.depth[0] = radius1 * inside;
  c.depth[1] = radius2 * inside;
  return c;
}

inline bool both_spheres(const Spheroid &one, const Spheroid &two) { return is_sphere(one) && is_sphere(two); }
inline bool both_spheres(const Triaxial &, const Triaxial &) { return false; }
inline EllipsoidContact contact_of_spheres(const Spheroid &one, const Spheroid &two, const double *d, double r) {
  return sphere_contact(sqrt(one.equatorial), sqrt(two.equatorial), d, r);
}
inline EllipsoidContact contact_of_spheres(const Triaxial &, const Triaxial &, const double *, double) { return {}; }

template <class Body> struct PairOf;
template <> struct PairOf<Spheroid> { using type = SpheroidPair; };
template <> struct PairOf<Triaxial> { using type = TriaxialPair; };

template <class Body>
EllipsoidContact solve(const Body &one, const Body &two, const double *d, double d2, double start, double tolerance) {
  EllipsoidContact c{};
  double lambda = start;
  if (!(lambda > 0.0 && lambda < 1.0)) {
    const double h1 = sqrt(support(one, d)), h2 = sqrt(support(two, d));
    lambda = h1 / (h1 + h2);
    if (d2 > h1 + h2) {
      c.lambda = lambda;
      c.gap = (d2 - h1 - h2) / sqrt(d2);
      return c;
    }
  }

  typename PairOf<Body>::type pair(one, two, d);
  double low = 0.0, high = 1.0, a, b, dp;
  for (bool settled = false;;) {
    if (!settled) pair.evaluate(lambda);
    a = sqrt(pair.support1);
    b = sqrt(pair.support2);
    dp = dot(d, pair.p);
    if (dp > a + b) {
      c.lambda = lambda;
      c.gap = (dp - a - b) / sqrt(dot(pair.p, pair.p));
      return c;
    }
    if (settled) break;
    if (c.steps == ELLIPSOID_STEPS) {
      c.fallback = true;
      break;
    }
    c.steps++;

    // The root of psi = lambda - a/(a+b): linear in lambda for spheres.
    const double m = 1.0 - lambda, off = m * a - lambda * b;
    (off > 0.0 ? low : high) = lambda;
    double along1, along2;
    pair.differentiate(along1, along2);
    const double ab = a * b, sum = a + b;
    const double slope = ab * sum * sum - (along1 * pair.support2 - along2 * pair.support1);
    const double step = off * sum * ab / slope;
    const double next = lambda + step;
    if (std::fabs(step) <= tolerance * std::min(lambda, m)) {
      pair.advance(step);
      lambda = next;
      settled = true;
    } else {
      lambda = next > low && next < high ? next : 0.5 * (low + high);
    }
  }

  const double m = 1.0 - lambda, outside = dp / (a + b), inside = (a + b - dp) / (a + b) * (1.0 + outside);
  const double p2 = dot(pair.p, pair.p), length = sqrt(p2);
  double b1p[3], inverse1, inverse2;
  pair.finish(b1p, inverse1, inverse2);
  c.touching = true;
  c.lambda = lambda;
  for (int k = 0; k < 3; k++) {
    c.normal[k] = pair.p[k] / length;
    c.point[k] = m * b1p[k];
  }
  c.depth[0] = depth_along(inside, m * length, inverse1, p2);
  c.depth[1] = depth_along(inside, lambda * length, inverse2, p2);
  return c;
}

}

Spheroid make_spheroid(const double semi_axes[3], const double quaternion[4]) {
  const int k = std::max(symmetry_axis(semi_axes).index, 0);
  const bool sphere = symmetry_axis(semi_axes).index < 0;
  Spheroid body;
  rotated_axis(quaternion, k, body.u);
  body.equatorial = semi_axes[(k + 1) % 3] * semi_axes[(k + 2) % 3];
  body.polar = sphere ? body.equatorial : semi_axes[k] * semi_axes[k];
  return body;
}

Triaxial make_triaxial(const double semi_axes[3], const double quaternion[4]) {
  Triaxial body;
  for (int k = 0; k < 3; k++) {
    rotated_axis(quaternion, k, body.axis[k]);
    body.square[k] = semi_axes[k] * semi_axes[k];
  }
  return body;
}

template <class Body>
EllipsoidContact ellipsoid_contact(const Body &one, const Body &two, const double d[3], double start, double tolerance) {
  const double d2 = dot(d, d);
  const double smallest = std::min(smallest_square(one), smallest_square(two));
  if (d2 < 1e-26 * smallest) {  // concentric: any normal would do; theirs is the shortest way out of the thinner one
    double n[3];
    shortest_axis(smallest_square(one) == smallest ? one : two, n);
    for (int k = 0; k < 3; k++) n[k] *= 1e-12 * sqrt(smallest);
    EllipsoidContact c = ellipsoid_contact(one, two, n, 0.0, tolerance);
    c.fallback = true;
    return c;
  }
  if (both_spheres(one, two)) return contact_of_spheres(one, two, d, sqrt(d2));
  return solve(one, two, d, d2, start, tolerance);
}

template EllipsoidContact ellipsoid_contact(const Spheroid &, const Spheroid &, const double[3], double, double);
template EllipsoidContact ellipsoid_contact(const Triaxial &, const Triaxial &, const double[3], double, double);

/** With g = B^-1 y, half the gradient of y.B^-1 y: K = 1/(det B (g.g)^2), H = (tr(B^-1) g.g - g.B^-1 g)/(2 |g|^3). */
template <>
double gaussian_curvature(const Spheroid &body, const double y[3]) {
  const double t = dot(body.u, y);
  double across = 0.0;
  for (int k = 0; k < 3; k++) across += (y[k] - t * body.u[k]) * (y[k] - t * body.u[k]);
  const double e = body.equatorial, g2 = across / (e * e) + t * t / (body.polar * body.polar);
  return 1.0 / (e * e * body.polar * g2 * g2);
}

template <>
double gaussian_curvature(const Triaxial &body, const double y[3]) {
  double g2 = 0.0, det = 1.0;
  for (int k = 0; k < 3; k++) {
    const double g = dot(body.axis[k], y) / body.square[k];
    g2 += g * g;
    det *= body.square[k];
  }
  return 1.0 / (det * g2 * g2);
}

template <>
double mean_curvature(const Spheroid &body, const double y[3]) {
  const double t = dot(body.u, y);
  double across = 0.0;
  for (int k = 0; k < 3; k++) across += (y[k] - t * body.u[k]) * (y[k] - t * body.u[k]);
  const double e = body.equatorial, a = body.polar;
  const double g2_across = across / (e * e), g2_along = t * t / (a * a), g2 = g2_across + g2_along;
  return (g2_across * (1.0 / e + 1.0 / a) + g2_along * 2.0 / e) / (2.0 * g2 * sqrt(g2));
}

template <>
double mean_curvature(const Triaxial &body, const double y[3]) {
  double g2 = 0.0, weighted = 0.0;
  for (int k = 0; k < 3; k++) {
    const double g = dot(body.axis[k], y) / body.square[k];
    g2 += g * g;
    weighted += g * g * (1.0 / body.square[(k + 1) % 3] + 1.0 / body.square[(k + 2) % 3]);
  }
  return weighted / (2.0 * g2 * sqrt(g2));
}

}

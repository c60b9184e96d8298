// SPDX-License-Identifier: GPL-2.0-or-later
#include "ellipsoid_contact.h"
#include "lanes.h"
#include "sphere_contact.h"
#include "symmetry_axis.h"
#include <algorithm>
#include <cmath>

// The widest vectors of the processor that the program finds itself on.
#if defined(__x86_64__) && defined(__GNUC__) && defined(__GLIBC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define GRAINSCOPE_CLONES __attribute__((flatten, target_clones("avx512f", "avx2", "default")))
#else
#define GRAINSCOPE_CLONES
#endif

namespace grainscope {

namespace {

template <class Real> GRAINSCOPE_INLINE Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
template <class Real> GRAINSCOPE_INLINE Real absolute(Real x) { return pick(x < 0.0, -x, x); }
template <class Real> GRAINSCOPE_INLINE Real least(Real a, Real b) { return pick(a < b, a, b); }

/** |v - (u.v) u|^2: not v.v - (u.v)^2, which cancels. */
template <class Real> GRAINSCOPE_INLINE Real across(const Real *v, const Real *u, Real along) {
  const Real a = v[0] - along * u[0], b = v[1] - along * u[1], c = v[2] - along * u[2];
  return a * a + b * b + c * c;
}

/** A spheroid, or several side by side. */
template <class Real> struct SpheroidOf {
  Real u[3], equatorial, polar, inverse_equatorial, inverse_polar, inverse_product;
};

template <class Real> GRAINSCOPE_INLINE Real support(const SpheroidOf<Real> &body, const Real *n) {
  const Real along = dot(body.u, n);
  return body.equatorial * across(n, body.u, along) + body.polar * along * along;
}

/** p = C^-1 d of two spheroids, in closed form: only the components of p along the two axes are unknown. */
template <class Real_> class SpheroidPair {
 public:
  using Real = Real_;
  using Body = SpheroidOf<Real>;

  /** p and what follows from it. t1, t2 are the components along the axes as they come out of the solution, to all digits; those that the
   *  supports are made of are from p as it was rounded: d.p / (a + b) hardly changes with p near its largest, but only for one and the
   *  same p. */
  struct State {
    Real p[3], t1, t2, support1, support2;  // supports: p.B1 p, p.B2 p
    Real along1, along2, across1, across2;  // components along the axes, squares of those across them
  };

  GRAINSCOPE_INLINE SpheroidPair(const Body &one, const Body &two, const Real *d)
      : one_(one), two_(two), excess1_(one.polar - one.equatorial), excess2_(two.polar - two.equatorial), d1_(dot(one.u, d)),
        d2_(dot(two.u, d)), c_(dot(one.u, two.u)), s2_(across(one.u, two.u, c_)) {
    for (int k = 0; k < 3; k++) d_[k] = d[k];
  }

  GRAINSCOPE_INLINE void evaluate(Real lambda, State &s) {
    const Real m = 1.0 - lambda;
    e_ = m * one_.equatorial + lambda * two_.equatorial;
    alpha1_ = m * excess1_;
    alpha2_ = lambda * excess2_;
    const Real det = e_ * (m * one_.polar + lambda * two_.polar) + alpha1_ * alpha2_ * s2_, both = 1.0 / (e_ * det);
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
    product1 = one_.equatorial * pw_ + excess1_ * s.t1 * y1_;
    product2 = two_.equatorial * pw_ + excess2_ * s.t2 * y2_;
  }

  /** Half the second derivatives of the supports: w.B1 w + 2 p.B1 v with v = C^-1 (B1 - B2) w, likewise B2. After differentiate(). */
  GRAINSCOPE_INLINE void differentiate_again(const State &s, Real &product1, Real &product2) {
    difference(y1_, y2_, z1_, z2_);
    f0_ = (one_.equatorial - two_.equatorial) * inverse_e_;
    g1_ = (excess1_ * y1_ - alpha1_ * z1_) * inverse_e_;
    g2_ = (excess2_ * y2_ + alpha2_ * z2_) * inverse_e_;
    const Real ww = f0_ * pw_ + f1_ * y1_ - f2_ * y2_, pv = f0_ * pw_ + g1_ * s.t1 - g2_ * s.t2, both = ww + 2.0 * pv;
    product1 = one_.equatorial * both + excess1_ * (y1_ * y1_ + 2.0 * s.t1 * z1_);
    product2 = two_.equatorial * both + excess2_ * (y2_ * y2_ + 2.0 * s.t2 * z2_);
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
    const Real f = m * one_.equatorial, g = m * excess1_ * s.t1;
    for (int k = 0; k < 3; k++) x[k] = f * s.p[k] + g * one_.u[k];
  }

  /** From a point where B^-1 x = share p, along p/|p| to the surface of 1 (or 2: against it), and the root of the Gaussian curvature
   *  there, 1/(sqrt(det B) g.g) with g = B^-1 y. `inside` is -G at the point. The quadratic's root is in the form that does not cancel. */
  GRAINSCOPE_INLINE void surface(const State &s, int which, Real share, Real inside, Real length, Real inverse_length, Real &depth,
                                 Real &curvature) const {
    const Body &body = which ? two_ : one_;
    const Real t = which ? s.along2 : s.along1, t2 = t * t, a = which ? s.across2 : s.across1, shared = share * length;
    const Real inverse = (a * body.inverse_equatorial + t2 * body.inverse_polar) * inverse_length * inverse_length;
    depth = inside / (shared + root(shared * shared + inside * inverse));
    const Real scaled = depth * inverse_length;
    const Real ge = share + scaled * body.inverse_equatorial, ga = share + scaled * body.inverse_polar;
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
    along_axes((one_.polar - two_.equatorial) * t1 - excess2_ * c_ * t2, excess1_ * c_ * t1 + (one_.equatorial - two_.polar) * t2, y1, y2);
  }

  GRAINSCOPE_INLINE void follow(State &s) const {
    s.along1 = dot(one_.u, s.p);
    s.along2 = dot(two_.u, s.p);
    s.across1 = across(s.p, one_.u, s.along1);
    s.across2 = across(s.p, two_.u, s.along2);
    s.support1 = one_.equatorial * s.across1 + one_.polar * s.along1 * s.along1;
    s.support2 = two_.equatorial * s.across2 + two_.polar * s.along2 * s.along2;
  }

  const Body &one_, &two_;
  Real d_[3], excess1_, excess2_, d1_, d2_, c_, s2_;
  Real e_, alpha1_, alpha2_, inverse_e_, inverse_det_;
  Real y1_, y2_, z1_, z2_, pw_, f0_, f1_, f2_, g1_, g2_;  // y, z: components of w and v along the axes; pw: p.w
};

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

  void surface(const State &s, int which, double share, double inside, double length, double inverse_length, double &depth,
               double &curvature) const {
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

/** The state of the lanes that are `settled`: a struct of nothing but Reals. */
template <class State> GRAINSCOPE_INLINE void keep(bool settled, const State &moved, State &kept) {
  if (settled) kept = moved;
}
template <class State> GRAINSCOPE_INLINE void keep(LaneMask settled, const State &moved, State &kept) {
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

/** EllipsoidContact, or several side by side. */
template <class Real> struct Answer {
  using Mask = typename MaskOf<Real>::type;
  Mask touching, apart, unsettled;
  Real lambda, normal[3], point[3], depth[2], curvature[2], gap, steps;
};

/** The solver, for one pair or for several side by side; a lane that has found its answer keeps it, whatever the others still need.
 *  Those that have not settled in `most_steps` are `unsettled`, and answered as far as they got. */
template <class Pair>
GRAINSCOPE_INLINE void solve(const typename Pair::Body &one, const typename Pair::Body &two, const typename Pair::Real *d,
                             typename Pair::Real start, double tolerance, int most_steps, Answer<typename Pair::Real> &answer) {
  using Real = typename Pair::Real;
  using Mask = typename MaskOf<Real>::type;
  const Mask cold = !((start > 0.0) & (start < 1.0));
  answer.touching = answer.apart = answer.unsettled = cold & !cold;
  answer.gap = answer.steps = Real{};
  Real lambda = start;
  if (any(cold)) {
    const Real d2 = dot(d, d), h1 = root(support(one, d)), h2 = root(support(two, d));
    lambda = pick(cold, h1 / (h1 + h2), lambda);
    answer.apart = cold & (d2 > h1 + h2);
    answer.gap = pick(answer.apart, (d2 - h1 - h2) / root(d2), answer.gap);
  }
  Mask open = !answer.apart;
  answer.lambda = lambda;
  if (!any(open)) return;

  Pair pair(one, two, d);
  typename Pair::State now, moved, kept;
  Real low{}, high = Real{} + 1.0;
  for (int round = 1;; round++) {
    pair.evaluate(lambda, now);
    if (round == 1) kept = now;
    const Real ab = root(now.support1 * now.support2), sum2 = now.support1 + now.support2 + 2.0 * ab, dp = dot(d, now.p);
    const Mask out = open & (dp * dp > sum2);  // p is a separating axis: d.p > a + b, a and b the roots of the supports
    if (any(out)) {
      answer.gap = pick(out, (dp - root(sum2)) / root(dot(now.p, now.p)), answer.gap);
      answer.apart = answer.apart | out;
      open = open & !out;
      if (!any(open)) break;
    }

    // The root of psi = lambda - a/(a+b): linear in lambda for spheres. (Both sides of the step times a b (a + b).)
    const Real m = 1.0 - lambda, off = m * now.support1 - lambda * now.support2 + (m - lambda) * ab;
    low = pick(off > 0.0, lambda, low);
    high = pick(off > 0.0, high, lambda);
    Real product1, product2;
    pair.differentiate(now, product1, product2);
    const Real slope = ab / (ab * sum2 - (product1 * now.support2 - product2 * now.support1)), step = off * slope;
    Real next = lambda + step;
    const Mask settled = open & (absolute(step) <= tolerance * least(lambda, m)), bracketed = (next > low) & (next < high);
    if (round == most_steps) answer.unsettled = open & !settled;
    const Mask last = settled | answer.unsettled;
    answer.steps = pick(open, answer.steps + 1.0, answer.steps);
    if (any(last)) {  // the supports there, to second order, tell how far off the root still is
      Real again1, again2;
      pair.differentiate_again(now, again1, again2);
      const Real a2 = now.support1 + step * (2.0 * product1 + step * again1), b2 = now.support2 + step * (2.0 * product2 + step * again2);
      const Real rest = ((1.0 - next) * a2 - next * b2 + (1.0 - 2.0 * next) * root(a2 * b2)) * slope;
      pair.advance(now, pick(settled, step + rest, Real{}), moved);
      keep(last, moved, kept);
      next = pick(settled, next + rest, next);
    }
    lambda = pick(open, pick(bracketed | settled, next, 0.5 * (low + high)), lambda);
    answer.touching = answer.touching | last;
    open = open & !last;
    if (!any(open)) break;
  }
  answer.lambda = lambda;
  if (!any(answer.touching)) return;

  const Real sum = root(kept.support1) + root(kept.support2), dp = dot(d, kept.p), apart = dp - sum;
  const Real length = root(dot(kept.p, kept.p)), inverse_length = 1.0 / length, m = 1.0 - lambda;
  const Mask out = answer.touching & (apart > 0.0);
  answer.gap = pick(out, apart * inverse_length, answer.gap);
  answer.apart = answer.apart | out;
  answer.touching = answer.touching & !out;
  const Real inverse_sum = 1.0 / sum, inside = -apart * inverse_sum * (1.0 + dp * inverse_sum);
  for (int k = 0; k < 3; k++) answer.normal[k] = kept.p[k] * inverse_length;
  pair.point(kept, m, answer.point);
  pair.surface(kept, 0, m, inside, length, inverse_length, answer.depth[0], answer.curvature[0]);
  pair.surface(kept, 1, lambda, inside, length, inverse_length, answer.depth[1], answer.curvature[1]);
}

inline double smallest_square(const Spheroid &body) { return std::min(body.equatorial, body.polar); }
inline double smallest_square(const Triaxial &body) { return *std::min_element(body.square, body.square + 3); }

/** Unit vector along a shortest semi-axis. */
inline void shortest_axis(const Spheroid &body, double *n) {
  if (body.polar <= body.equatorial) {
    std::copy(body.u, body.u + 3, n);
    return;
  }
  int across = 0;  // the coordinate axis that is farthest from the symmetry axis, made perpendicular to it
  for (int k = 1; k < 3; k++)
    if (std::fabs(body.u[k]) < std::fabs(body.u[across])) across = k;
  const double length = root(1.0 - body.u[across] * body.u[across]);
  for (int k = 0; k < 3; k++) n[k] = ((k == across) - body.u[across] * body.u[k]) / length;
}

inline void shortest_axis(const Triaxial &body, double *n) {
  const int least = static_cast<int>(std::min_element(body.square, body.square + 3) - body.square);
  std::copy(body.axis[least], body.axis[least] + 3, n);
}

/** Centres so close that their line has no direction. */
template <class Body> inline bool concentric(const Body &one, const Body &two, const double *d) {
  return dot(d, d) < 1e-26 * std::min(smallest_square(one), smallest_square(two));
}

inline bool is_sphere(const Spheroid &body) { return body.polar == body.equatorial; }

inline double number(double lane, int) { return lane; }
inline double number(const Lanes &lanes, int k) { return lanes[k]; }

/** One lane's answer. Of those that do not touch, only what is defined. */
template <class Real>
GRAINSCOPE_INLINE void unpack(const Answer<Real> &answer, int lane, bool touching, bool unsettled, EllipsoidContact &c) {
  c = EllipsoidContact{};
  c.touching = touching;
  c.fallback = unsettled;
  c.steps = static_cast<int>(number(answer.steps, lane));
  c.lambda = number(answer.lambda, lane);
  c.gap = number(answer.gap, lane);
  if (!touching) return;
  for (int k = 0; k < 3; k++) {
    c.normal[k] = number(answer.normal[k], lane);
    c.point[k] = number(answer.point[k], lane);
  }
  for (int k = 0; k < 2; k++) {
    c.depth[k] = number(answer.depth[k], lane);
    c.curvature[k] = number(answer.curvature[k], lane);
  }
}

template <class Pair, class Body, class Pose>
EllipsoidContact regular_contact(const Body &one, const Body &two, const Pose &pose1, const Pose &pose2, const double *d, double start,
                                 double tolerance) {
  if (concentric(one, two, d)) {  // any normal would do; theirs is the shortest way out of the thinner one
    const double square1 = smallest_square(one), square2 = smallest_square(two);
    double n[3];
    shortest_axis(square1 <= square2 ? one : two, n);
    for (int k = 0; k < 3; k++) n[k] *= 1e-12 * root(std::min(square1, square2));
    EllipsoidContact c = regular_contact<Pair>(one, two, pose1, pose2, n, 0.0, tolerance);
    c.fallback = true;
    return c;
  }
  Answer<double> answer;
  solve<Pair>(pose1, pose2, d, start, tolerance, ELLIPSOID_STEPS, answer);
  EllipsoidContact c;
  unpack(answer, 0, answer.touching, answer.unsettled, c);
  return c;
}

inline SpheroidOf<double> pose_of(const Spheroid &body) {
  return {{body.u[0], body.u[1], body.u[2]}, body.equatorial, body.polar, body.inverse_equatorial, body.inverse_polar,
          body.inverse_product};
}

inline void set_shape(const Spheroid &body, int lane, SpheroidOf<Lanes> &lanes) {
  for (int c = 0; c < 3; c++) lanes.u[c][lane] = body.u[c];
  lanes.equatorial[lane] = body.equatorial;
  lanes.polar[lane] = body.polar;
  lanes.inverse_equatorial[lane] = body.inverse_equatorial;
  lanes.inverse_polar[lane] = body.inverse_polar;
  lanes.inverse_product[lane] = body.inverse_product;
}

constexpr double TOLERANCE = 3e-5;
constexpr int LANE_STEPS = 6;  // those that need more are asked again, alone

/** LANES pairs, from spheroids by rows of components. */
GRAINSCOPE_CLONES void solve_lanes(const SpheroidOf<Lanes> &one, const SpheroidOf<Lanes> &two, const Lanes *d, const Lanes &start,
                                   Answer<Lanes> &answer) {
  solve<SpheroidPair<Lanes>>(one, two, d, start, TOLERANCE, LANE_STEPS, answer);
}

}

Spheroid make_spheroid(const double semi_axes[3], const double quaternion[4]) {
  const int k = std::max(symmetry_axis(semi_axes).index, 0);
  const bool sphere = symmetry_axis(semi_axes).index < 0;
  Spheroid body;
  rotated_axis(quaternion, k, body.u);
  body.equatorial = semi_axes[(k + 1) % 3] * semi_axes[(k + 2) % 3];
  body.polar = sphere ? body.equatorial : semi_axes[k] * semi_axes[k];
  body.inverse_equatorial = 1.0 / body.equatorial;
  body.inverse_polar = 1.0 / body.polar;
  body.inverse_product = body.inverse_equatorial * root(body.inverse_polar);
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

template <>
EllipsoidContact ellipsoid_contact(const Spheroid &one, const Spheroid &two, const double d[3], double start, double tolerance) {
  if (is_sphere(one) && is_sphere(two) && !concentric(one, two, d))
    return sphere_contact(root(one.equatorial), root(two.equatorial), d, dot(d, d));
  return regular_contact<SpheroidPair<double>>(one, two, pose_of(one), pose_of(two), d, start, tolerance);
}

template <>
EllipsoidContact ellipsoid_contact(const Triaxial &one, const Triaxial &two, const double d[3], double start, double tolerance) {
  return regular_contact<TriaxialPair>(one, two, one, two, d, start, tolerance);
}

void ellipsoid_contacts(int n, const EllipsoidPair *pairs, EllipsoidContact *contacts) {
  for (int first = 0; first < n; first += LANES) {
    const int many = std::min(LANES, n - first);
    if (many < 3) {  // not worth the lanes
      for (int k = first; k < n; k++) contacts[k] = ellipsoid_contact(*pairs[k].one, *pairs[k].two, pairs[k].d, pairs[k].start, TOLERANCE);
      return;
    }
    SpheroidOf<Lanes> one, two;
    Lanes d[3], start;
    bool alone[LANES], together = false;
    for (int k = 0; k < LANES; k++) {
      const EllipsoidPair &pair = pairs[first + std::min(k, many - 1)];  // idle lanes repeat the last pair
      for (int c = 0; c < 3; c++) d[c][k] = pair.d[c];
      set_shape(*pair.one, k, one);
      set_shape(*pair.two, k, two);
      start[k] = pair.start;
      alone[k] = (is_sphere(*pair.one) && is_sphere(*pair.two)) || concentric(*pair.one, *pair.two, pair.d);
      together = together || !alone[k];
    }
    Answer<Lanes> answer;
    if (together) solve_lanes(one, two, d, start, answer);
    for (int k = 0; k < many; k++) {
      const EllipsoidPair &pair = pairs[first + k];
      if (alone[k] || answer.unsettled[k]) contacts[first + k] = ellipsoid_contact(*pair.one, *pair.two, pair.d, pair.start, TOLERANCE);
      else unpack(answer, k, answer.touching[k], false, contacts[first + k]);
    }
  }
}

/** With g = B^-1 y, half the gradient of y.B^-1 y: K = 1/(det B (g.g)^2), H = (tr(B^-1) g.g - g.B^-1 g)/(2 |g|^3). */
template <>
double gaussian_curvature(const Spheroid &body, const double y[3]) {
  const double t = dot(body.u, y), e = body.equatorial, a = body.polar;
  const double g2 = across(y, body.u, t) / (e * e) + t * t / (a * a);
  return 1.0 / (e * e * a * g2 * g2);
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
  const double t = dot(body.u, y), e = body.equatorial, a = body.polar;
  const double g2_across = across(y, body.u, t) / (e * e), g2_along = t * t / (a * a), g2 = g2_across + g2_along;
  return (g2_across * (1.0 / e + 1.0 / a) + g2_along * 2.0 / e) / (2.0 * g2 * root(g2));
}

template <>
double mean_curvature(const Triaxial &body, const double y[3]) {
  double g2 = 0.0, weighted = 0.0;
  for (int k = 0; k < 3; k++) {
    const double g = dot(body.axis[k], y) / body.square[k];
    g2 += g * g;
    weighted += g * g * (1.0 / body.square[(k + 1) % 3] + 1.0 / body.square[(k + 2) % 3]);
  }
  return weighted / (2.0 * g2 * root(g2));
}

}

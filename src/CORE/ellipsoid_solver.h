// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ELLIPSOID_SOLVER_H
#define GRAINSCOPE_ELLIPSOID_SOLVER_H

#include "ellipsoid_contact.h"
#include "spheroid_pair.h"
#include "triaxial_pair.h"
#include <cmath>

/** The solver of ellipsoid_contact.h, one source for one pair and for several side by side. */
namespace grainscope { namespace contact_solver {

/** EllipsoidContact, or several side by side. */
template <class Real>
struct Answer {
  using Mask = typename MaskOf<Real>::type;
  Mask touching, apart, unsettled;
  Real lambda, normal[3], point[3], depth[2], curvature[2], gap, steps;
};

/** The solver, for one pair or for several side by side. A lane that has converged keeps its result while the others go
 *  on. Lanes that have not converged in `most_steps` are `unsettled` and give their last iterate. */
template <class Pair>
GRAINSCOPE_INLINE void solve(const typename Pair::Body &one, const typename Pair::Body &two,
                             const typename Pair::Real *d, typename Pair::Real start, double tolerance, int most_steps,
                             Answer<typename Pair::Real> &answer) {
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
    const Real ab = root(now.support1 * now.support2), sum2 = now.support1 + now.support2 + 2.0 * ab,
               dp = dot(d, now.p);
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
    const Mask settled = open & (absolute(step) <= tolerance * least(lambda, m)),
               bracketed = (next > low) & (next < high);
    if (round == most_steps) answer.unsettled = open & !settled;
    const Mask last = settled | answer.unsettled;
    answer.steps = pick(open, answer.steps + 1.0, answer.steps);
    if (any(last)) {  // the supports there, to second order, tell how far off the root still is
      Real again1, again2;
      pair.differentiate_again(now, again1, again2);
      const Real a2 = now.support1 + step * (2.0 * product1 + step * again1),
                 b2 = now.support2 + step * (2.0 * product2 + step * again2);
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

}}

#endif

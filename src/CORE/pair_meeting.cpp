// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_group.h"
#include "concentric.h"
#include "ellipsoid_solver.h"
#include "pair_places.h"
#include <algorithm>

namespace grainscope {

namespace {

using namespace contact_solver;

constexpr int LANE_STEPS = 6;  // pairs that need more are solved again, alone

/** The lanes that hold pairs of their own. */
GRAINSCOPE_INLINE LaneMask filled(const PairGroup &group) {
  const LaneMask lane = {0, 1, 2, 3};
  return lane < (long)group.size + LaneMask{};
}

/** What follows from what is reachable and touching. */
GRAINSCOPE_INLINE void count(LaneMask there, GroupGeometry &g, SolverTally &tally) {
  g.apart = there & ~g.touching;
  const LaneMask counted = g.reachable & ~g.alone;
  tally.solved += counted;
  tally.touching += counted & g.touching;
  const Lanes steps = pick(counted, g.steps, Lanes{});
  tally.steps += steps;
  tally.most_steps = pick(tally.most_steps < steps, steps, tally.most_steps);
}

GRAINSCOPE_INLINE void distance(const Lanes *xi, const Lanes *xj, LaneMask there, Lanes *d, Lanes &square,
                                LaneMask &reachable, GroupGeometry &g) {
  for (int k = 0; k < 3; k++) {
    d[k] = xj[k] - xi[k];
    g.d[k] = d[k];
  }
  square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  const Lanes reach = xi[3] + xj[3];
  reachable = there & (square < reach * reach);
  g.square = square;
  g.reachable = reachable;
}

/** Four spheroids, by their numbers. */
GRAINSCOPE_INLINE void load_spheroids(const PackedGrains &grains, const int *numbers, SpheroidOf<Lanes> &body) {
  Lanes axis[4], shape[4];
  load_rows([&](int k) { return grains.grains[numbers[k]].axis; }, axis);
  if (grains.one_shape) {
    const PackedShape &one = grains.shapes[0];
    shape[0] = one.equatorial_square + Lanes{};
    shape[1] = one.polar_square + Lanes{};
    shape[2] = one.inverse_equatorial_square + Lanes{};
    shape[3] = one.inverse_polar_square + Lanes{};
  } else {
    load_rows([&](int k) { return &grains.shapes[numbers[k]].equatorial_square; }, shape);
  }
  body = {{axis[0], axis[1], axis[2]}, shape[0], shape[1], shape[2], shape[3], axis[3]};
}

/** Both grains of each pair, and their distance; the lanes that hold pairs. */
GRAINSCOPE_INLINE LaneMask load_pairs(const PackedGrains &grains, const PairGroup &group, GroupGeometry &g, Lanes *xi,
                                      Lanes *xj, Lanes *d, Lanes &square, LaneMask &reachable, SpheroidOf<Lanes> &one,
                                      SpheroidOf<Lanes> &two) {
  const LaneMask there = filled(group);
  load_places(grains, group, xi, xj);
  distance(xi, xj, there, d, square, reachable, g);
  load_spheroids(grains, group.i, one);
  load_spheroids(grains, group.j, two);
  return there;
}

GRAINSCOPE_INLINE void part_spheroids_of(const PackedGrains &grains, const PairGroup &group, GroupGeometry &g) {
  constexpr double MARGIN = 1e-12;
  Lanes xi[4], xj[4], d[3], square;
  LaneMask reachable;
  SpheroidOf<Lanes> one, two;
  const LaneMask there = load_pairs(grains, group, g, xi, xj, d, square, reachable, one, two);
  SpheroidPair<Lanes> pair(one, two, d);
  const Lanes h1 = root(support(one, d)), h2 = root(support(two, d));
  typename SpheroidPair<Lanes>::State s;
  pair.evaluate(h1 / (h1 + h2), s);
  const Lanes sum = root(s.support1) + root(s.support2), dp = dot(d, s.p);
  g.apart = there & (~reachable | (dp > sum * (1.0 + MARGIN)));
  g.gap = pick(reachable, (dp - sum) / root(dot(s.p, s.p)), root(square) - xi[3] - xj[3]);
}

GRAINSCOPE_INLINE void meet_spheroids_of(const PackedGrains &grains, const PairGroup &group, GroupGeometry &g,
                                         SolverTally &tally) {
  Lanes xi[4], xj[4], d[3], square;
  LaneMask reachable;
  SpheroidOf<Lanes> one, two;
  const LaneMask there = load_pairs(grains, group, g, xi, xj, d, square, reachable, one, two);
  Lanes start;
  for (int k = 0; k < LANES; k++) start[k] = *group.history[k];
  const LaneMask stranger = start == 0.0;
  start = pick(stranger, Lanes{}, start + 0.5);
  Answer<Lanes> a{};
  solve<SpheroidPair<Lanes>>(one, two, d, start, ELLIPSOID_TOLERANCE, LANE_STEPS, a);

  // What is_sound() asks, and concentric().
  Lanes sum = a.depth[0] + a.depth[1] + a.curvature[0] + a.curvature[1];
  for (int k = 0; k < 3; k++) sum += absolute(a.point[k]);
  const LaneMask sound = pick(a.touching,
                              (absolute(dot(a.normal, a.normal) - 1.0) < 1e-9) & (a.depth[0] >= 0.0) &
                                  (a.depth[1] >= 0.0) & (sum < HUGE_VAL),
                              a.gap >= 0.0);
  const Lanes smallest =
      least(least(one.equatorial_square, one.polar_square), least(two.equatorial_square, two.polar_square));
  const LaneMask alone = a.unsettled | !sound | (square < 1e-26 * smallest);
  for (int k = 0; k < 3; k++) {
    g.normal[k] = a.normal[k];
    g.point[k] = a.point[k];
  }
  for (int k = 0; k < 2; k++) {
    g.depth[k] = a.depth[k];
    g.curvature[k] = a.curvature[k];
  }
  g.lambda = a.lambda;
  g.gap = pick(reachable, a.gap, root(square) - xi[3] - xj[3]);
  g.steps = a.steps;
  g.touching = a.touching & reachable;
  g.alone = alone & reachable;
  g.met = g.touching & stranger;
  count(there, g, tally);
}

/** sphere_contact(). */
GRAINSCOPE_INLINE void meet_round_of(const PackedGrains &grains, const PairGroup &group, GroupGeometry &g,
                                     SolverTally &tally) {
  Lanes xi[4], xj[4], axis[4], d[3], square;
  LaneMask reachable;
  const LaneMask there = filled(group);
  load_places(grains, group, xi, xj);
  distance(xi, xj, there, d, square, reachable, g);
  load_rows([&](int k) { return grains.grains[group.i[k]].axis; }, axis);
  const Lanes radius1 = axis[0];
  load_rows([&](int k) { return grains.grains[group.j[k]].axis; }, axis);
  const Lanes radius2 = axis[0], r = root(square), sum = radius1 + radius2, inverse_sum = 1.0 / sum,
              inverse_r = 1.0 / r, inside = (sum - r) * inverse_sum;
  g.lambda = radius1 * inverse_sum;
  for (int k = 0; k < 3; k++) {
    g.normal[k] = d[k] * inverse_r;
    g.point[k] = g.lambda * d[k];
  }
  g.depth[0] = radius1 * inside;
  g.depth[1] = radius2 * inside;
  g.curvature[0] = 1.0 / radius1;
  g.curvature[1] = 1.0 / radius2;
  g.gap = pick(reachable, r - sum, r - xi[3] - xj[3]);
  g.steps = Lanes{};
  const Lanes small = 1e-10 * least(radius1, radius2);
  g.touching = reachable & (r < sum);
  g.alone = reachable & (square < small * small);
  g.met = g.touching;  // the history does not tell
  count(there, g, tally);
}

/** Of spheres that are known by their radius alone. */
GRAINSCOPE_INLINE void meet_spheres_of(const PackedGrains &grains, const PairGroup &group, GroupGeometry &g) {
  Lanes xi[4], xj[4], d[3], square;
  LaneMask reachable;
  const LaneMask there = filled(group);
  load_places(grains, group, xi, xj);
  distance(xi, xj, there, d, square, reachable, g);
  g.gap = root(square) - xi[3] - xj[3];
  g.touching = g.met = reachable;
  g.apart = there & ~reachable;
}

}

GRAINSCOPE_CLONES
std::uint64_t within_reach(const PackedGrain *grains, int i, const int *others, int mask, int count) {
  const PackedGrain &grain = grains[i];
  std::uint64_t bits = 0;
  for (int first = 0; first < count; first += LANES) {
    Lanes x[4];
    load_rows([&](int k) { return grains[others[std::min(first + k, count - 1)] & mask].x; }, x);
    const Lanes dx = grain.x[0] - x[0], dy = grain.x[1] - x[1], dz = grain.x[2] - x[2], reach = grain.reach + x[3];
    const LaneMask within = dx * dx + dy * dy + dz * dz < reach * reach;
    const std::uint64_t four = (within[0] & 1) | (within[1] & 2) | (within[2] & 4) | (within[3] & 8);
    bits |= four << first;
  }
  return count < 64 ? bits & ((std::uint64_t(1) << count) - 1) : bits;
}
GRAINSCOPE_CLONES
void meet_spheroids(const PackedGrains &grains, const PairGroup &group, GroupGeometry &g, SolverTally &tally) {
  meet_spheroids_of(grains, group, g, tally);
}
GRAINSCOPE_CLONES
void part_spheroids(const PackedGrains &grains, const PairGroup &group, GroupGeometry &g) {
  part_spheroids_of(grains, group, g);
}
GRAINSCOPE_CLONES
void meet_round(const PackedGrains &grains, const PairGroup &group, GroupGeometry &g, SolverTally &tally) {
  meet_round_of(grains, group, g, tally);
}
GRAINSCOPE_CLONES
void meet_spheres(const PackedGrains &grains, const PairGroup &group, GroupGeometry &g) {
  meet_spheres_of(grains, group, g);
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_group.h"
#include "concentric.h"
#include "ellipsoid_solver.h"
#include "group_wrenches.h"
#include <algorithm>

namespace grainscope {

namespace {

using namespace contact_solver;
using namespace pair_law;

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

GRAINSCOPE_INLINE void load_places(const PackedGrains &grains, const PairGroup &group, Lanes *xi, Lanes *xj) {
  load_rows([&](int k) { return grains.grains[group.i[k]].x; }, xi);
  load_rows([&](int k) { return grains.grains[group.j[k]].x; }, xj);
}

GRAINSCOPE_INLINE void part_spheroids_of(const PackedGrains &grains, const PairGroup &group, GroupGeometry &g) {
  constexpr double MARGIN = 1e-12;
  Lanes xi[4], xj[4], d[3], square;
  LaneMask reachable;
  const LaneMask there = filled(group);
  load_places(grains, group, xi, xj);
  distance(xi, xj, there, d, square, reachable, g);
  SpheroidOf<Lanes> one, two;
  load_spheroids(grains, group.i, one);
  load_spheroids(grains, group.j, two);
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
  const LaneMask there = filled(group);
  load_places(grains, group, xi, xj);
  distance(xi, xj, there, d, square, reachable, g);
  SpheroidOf<Lanes> one, two;
  load_spheroids(grains, group.i, one);
  load_spheroids(grains, group.j, two);
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

struct Sides {
  Lanes velocity[2][4], spin[2][4];  // fourth: mass, size
};

GRAINSCOPE_INLINE void load_motion(const PackedGrains &grains, const PairGroup &group, Sides &s) {
  load_rows([&](int k) { return grains.grains[group.i[k]].velocity; }, s.velocity[0]);
  load_rows([&](int k) { return grains.grains[group.j[k]].velocity; }, s.velocity[1]);
  load_rows([&](int k) { return grains.grains[group.i[k]].spin; }, s.spin[0]);
  load_rows([&](int k) { return grains.grains[group.j[k]].spin; }, s.spin[1]);
}

GRAINSCOPE_INLINE Lanes effective_mass(const Sides &s, const GroupLaw &law) {
  const Lanes mi = s.velocity[0][3], mj = s.velocity[1][3];
  Lanes mass = mi * mj / (mi + mj);
  if (law.frozen) {
    mass = pick(law.frozen_i, mj, mass);
    mass = pick(law.frozen_j, mi, mass);
  }
  return mass;
}

GRAINSCOPE_INLINE void coefficients(const GroupLaw &law, Coefficients<Lanes> &c) {
  if (law.law->types == 1) {
    for (int k = 0; k < 4; k++) c.constant[k] = law.terms[0]->constant[k] + Lanes{};
    c.friction = law.terms[0]->friction + Lanes{};
    return;
  }
  load_rows([&](int k) { return law.terms[k]->constant; }, c.constant);
  for (int k = 0; k < LANES; k++) c.friction[k] = law.terms[k]->friction;
}

GRAINSCOPE_INLINE void cross(const Lanes *a, const Lanes *b, Lanes *c) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

/** The columns of the history: lambda - 1/2 and a spring. */
struct LambdaAndSpring {
  static constexpr bool lambda = true;
  static GRAINSCOPE_INLINE void get(const PairGroup &group, Lanes *columns) {
    load_rows([&](int k) { return group.history[k]; }, columns);
  }
  static GRAINSCOPE_INLINE void put(Lanes row, double *history) { store(row, history); }
};
/** A spring alone: three columns, which are the first of `columns`, too. */
struct SpringAlone {
  static constexpr bool lambda = false;
  static GRAINSCOPE_INLINE void get(const PairGroup &group, Lanes *columns) {
    Lanes rows[LANES];
    for (int k = 0; k < LANES; k++) {
      const double *h = group.history[k];
      rows[k] = Lanes{h[0], h[1], h[2], h[2]};
    }
    transpose(rows, columns);
  }
  static GRAINSCOPE_INLINE void put(Lanes row, double *history) {
    for (int k = 0; k < 3; k++) history[k] = row[k];
  }
};

GRAINSCOPE_INLINE Lanes weight_of(const PackedGrains &grains, const PairGroup &group, LaneMask touching) {
  LaneMask j;
  for (int k = 0; k < LANES; k++) j[k] = group.j[k];
  return pick(touching, pick(j < (long)grains.own + LaneMask{}, 1.0 + Lanes{}, 0.5 + Lanes{}), Lanes{});
}

/** A contact point, and what leads to it from the centre of i. */
struct Place {
  Lanes point[3], arm[3];
  GRAINSCOPE_INLINE void set(const Lanes *x_i, int k, Lanes at) {
    point[k] = at;
    arm[k] = at - x_i[k];
  }
};

GRAINSCOPE_INLINE void keep_forces(LaneMask touching, const Approach<Lanes> &a, const Normal<Lanes> &n,
                                   const Friction<Lanes> &f, Lanes friction, Lanes limit, const Lanes *force,
                                   const Place &place, const Lanes *before, GroupForces &kept) {
  const auto touched = [touching](Lanes x) { return pick(touching, x, Lanes{}); };
  for (int k = 0; k < 3; k++) {
    kept.normal[k] = touched(a.normal[k]);
    kept.force[k] = touched(force[k]);
  }
  kept.overlap = touched(a.overlap);
  kept.law_force = touched(n.force);
  kept.kn = touched(n.kn);
  kept.kt = touched(n.kt);
  kept.gamma_n = touched(n.gamma_n);
  kept.gamma_t = touched(n.gamma_t);
  kept.friction = touched(friction);
  kept.limit = touched(limit);
  kept.length = touched(f.length);
  kept.cut = touching & f.cut;
  if (!kept.motion) return;
  kept.normal_velocity = touched(a.normal_velocity);
  for (int k = 0; k < 3; k++) {
    kept.tangential_velocity[k] = touched(a.tangential_velocity[k]);
    kept.arm[k] = touched(place.arm[k]);
  }
  if (!kept.springs) return;
  for (int k = 0; k < 3; k++) {
    kept.point[k] = touched(place.point[k]);
    kept.before[k] = touched(before[k]);
    kept.uncut[k] = touched(f.uncut[k]);
    kept.after[k] = touched(f.spring[k]);
  }
}

/** Torques of a normal and a tangential force on i, at their arms. */
struct ArmTorques {
  const Lanes *arm_i, *arm_j;
  bool friction;
  GRAINSCOPE_INLINE void operator()(const Lanes *normal, const Lanes *tangential, Lanes *on_i, Lanes *on_j) const {
    Lanes against[3], more_i[3], more_j[3];
    for (int k = 0; k < 3; k++) against[k] = -normal[k];
    cross(arm_i, normal, on_i);
    cross(arm_j, against, on_j);
    if (!friction) return;
    for (int k = 0; k < 3; k++) against[k] = -tangential[k];
    cross(arm_i, tangential, more_i);
    cross(arm_j, against, more_j);
    for (int k = 0; k < 3; k++) {
      on_i[k] += more_i[k];
      on_j[k] += more_j[k];
    }
  }
};

/** Of a tangential force on spheres, by the distances of the contact point from their centres. */
struct LeverTorques {
  const Lanes *normal, *lever;
  GRAINSCOPE_INLINE void operator()(const Lanes *, const Lanes *tangential, Lanes *on_i, Lanes *on_j) const {
    Lanes t[3];
    cross(normal, tangential, t);
    for (int k = 0; k < 3; k++) {
      on_i[k] = -lever[0] * t[k];
      on_j[k] = -lever[1] * t[k];
    }
  }
};

/** Everything from the approach on. `lambda`: of the history from now on; what it was where null. */
template <class History, class Torques>
GRAINSCOPE_INLINE void push(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &g,
                            const GroupLaw &law, const Approach<Lanes> &a, const Place &place, const Lanes *lambda,
                            Torques torques, GroupForces *kept) {
  Coefficients<Lanes> c;
  coefficients(law, c);
  const Normal<Lanes> n = normal_force(*law.law, c, a);
  const Lanes limit = c.friction * absolute(n.force);
  Lanes history[4] = {}, *before = history + History::lambda;
  Friction<Lanes> f{};
  if (law.law->tangential == PairLaw::Tangential::history) {
    History::get(group, history);
    spring_friction(*law.law, limit, a, n, before, f);
  } else if (law.law->tangential == PairLaw::Tangential::no_history) {
    viscous_friction(limit, a, n, f);
  }
  Lanes normal[3], force[3], torque_i[3], torque_j[3];
  for (int k = 0; k < 3; k++) {
    normal[k] = n.force * a.normal[k];
    force[k] = 0.0 + normal[k] + f.force[k];
  }
  torques(normal, f.force, torque_i, torque_j);
  add_wrenches(group, g.touching, force, torque_i, torque_j, grains.own, grains.forces);
  if (kept) {
    kept->weight = weight_of(grains, group, g.touching);
    keep_forces(g.touching, a, n, f, c.friction, limit, force, place, before, *kept);
  }
  if (law.law->tangential == PairLaw::Tangential::history) {
    Lanes columns[4], rows[LANES];
    columns[0] = lambda ? *lambda : history[0];
    columns[3] = f.spring[2];
    for (int k = 0; k < 3; k++) columns[k + History::lambda] = f.spring[k];
    transpose(columns, rows);
    for (int k = 0; k < LANES; k++)
      if (g.touching[k]) History::put(rows[k], group.history[k]);
  } else if (lambda) {
    for (int k = 0; k < LANES; k++)
      if (g.touching[k]) *group.history[k] = (*lambda)[k];
  }
}

template <bool round>
GRAINSCOPE_INLINE void push_ellipsoids_of(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &g,
                                          const GroupLaw &law, GroupForces *kept) {
  Sides s;
  load_motion(grains, group, s);
  Approach<Lanes> a;
  const Lanes size_i = s.spin[0][3], size_j = s.spin[1][3];
  a.radius = size_i * size_j / (size_i + size_j);
  if (!round && law.law->curvature_limit > 0.0)
    a.radius = least(a.radius * law.law->curvature_limit, 1.0 / (g.curvature[0] + g.curvature[1]));
  a.overlap = g.depth[0] + g.depth[1];
  a.mass = effective_mass(s, law);

  Lanes xi[4], xj[4], arm_j[3];
  Place place;
  load_places(grains, group, xi, xj);
  for (int k = 0; k < 3; k++) {
    a.normal[k] = -g.normal[k];
    place.set(xi, k, xi[k] + g.point[k]);
    arm_j[k] = place.point[k] - xj[k];
  }
  Lanes turn_i[3], turn_j[3], v[3];
  cross(s.spin[0], place.arm, turn_i);
  cross(s.spin[1], arm_j, turn_j);
  for (int k = 0; k < 3; k++) v[k] = s.velocity[0][k] - s.velocity[1][k] + turn_i[k] - turn_j[k];
  a.normal_velocity = v[0] * a.normal[0] + v[1] * a.normal[1] + v[2] * a.normal[2];
  for (int k = 0; k < 3; k++) a.tangential_velocity[k] = v[k] - a.normal_velocity * a.normal[k];

  if (round) {
    const Lanes lever[2] = {size_i - g.depth[0], size_j - g.depth[1]};
    for (int k = 0; k < 3; k++) place.set(xi, k, xi[k] - lever[0] * a.normal[k]);
    push<LambdaAndSpring>(grains, group, g, law, a, place, nullptr, LeverTorques{a.normal, lever}, kept);
  } else {
    const bool friction = law.law->tangential != PairLaw::Tangential::off;
    const Lanes lambda = g.lambda - 0.5;
    push<LambdaAndSpring>(grains, group, g, law, a, place, &lambda, ArmTorques{place.arm, arm_j, friction}, kept);
  }
}

GRAINSCOPE_INLINE void push_spheres_of(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &g,
                                       const GroupLaw &law, GroupForces *kept) {
  Sides s;
  load_motion(grains, group, s);
  Approach<Lanes> a;
  const Lanes radius_i = s.spin[0][3], radius_j = s.spin[1][3], r = root(g.square), inverse = 1.0 / r;
  a.radius = radius_i * radius_j / (radius_i + radius_j);
  a.overlap = radius_i + radius_j - r;
  a.mass = effective_mass(s, law);
  const Lanes half = 0.5 * a.overlap, lever_i = radius_i - half, lever_j = radius_j - half;
  Lanes xi[4], d[3], v[3], w[3];
  Place place;
  load_rows([&](int k) { return grains.grains[group.i[k]].x; }, xi);
  for (int k = 0; k < 3; k++) {
    d[k] = -g.d[k];
    a.normal[k] = d[k] * inverse;
    v[k] = s.velocity[0][k] - s.velocity[1][k];
    w[k] = (lever_i * s.spin[0][k] + lever_j * s.spin[1][k]) * inverse;
    place.set(xi, k, xi[k] - lever_i * a.normal[k]);
  }
  a.normal_velocity = v[0] * a.normal[0] + v[1] * a.normal[1] + v[2] * a.normal[2];
  for (int k = 0; k < 3; k++) {
    const int l = (k + 1) % 3, m = (k + 2) % 3;
    const Lanes along = a.normal_velocity * a.normal[k];
    a.tangential_velocity[k] = (v[k] - along) - (d[m] * w[l] - d[l] * w[m]);
  }
  const Lanes lever[2] = {lever_i, lever_j};
  push<SpringAlone>(grains, group, g, law, a, place, nullptr, LeverTorques{a.normal, lever}, kept);
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
GRAINSCOPE_CLONES
void push_ellipsoids(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &g, const GroupLaw &law,
                     GroupForces *kept) {
  push_ellipsoids_of<false>(grains, group, g, law, kept);
}
GRAINSCOPE_CLONES
void push_round(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &g, const GroupLaw &law,
                GroupForces *kept) {
  push_ellipsoids_of<true>(grains, group, g, law, kept);
}
GRAINSCOPE_CLONES
void push_spheres(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &g, const GroupLaw &law,
                  GroupForces *kept) {
  push_spheres_of(grains, group, g, law, kept);
}

}

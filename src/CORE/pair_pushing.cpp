// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_group.h"
#include "pair_places.h"
#include "group_wrenches.h"
#include "half_step.h"
#include <algorithm>

namespace grainscope {

namespace {

using namespace pair_law;
using half_step::Moment;
using half_step::Motion;
using half_step::outer;

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
  if (kept.points)
    for (int k = 0; k < 3; k++) kept.point[k] = touched(place.point[k]);
  if (!kept.springs) return;
  for (int k = 0; k < 3; k++) {
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
    outer(arm_i, normal, on_i);
    outer(arm_j, against, on_j);
    if (!friction) return;
    for (int k = 0; k < 3; k++) against[k] = -tangential[k];
    outer(arm_i, tangential, more_i);
    outer(arm_j, against, more_j);
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
    outer(normal, tangential, t);
    for (int k = 0; k < 3; k++) {
      on_i[k] = -lever[0] * t[k];
      on_j[k] = -lever[1] * t[k];
    }
  }
};

GRAINSCOPE_INLINE Motion<Lanes> motion_of(const Sides &s) {
  Motion<Lanes> m;
  for (int k = 0; k < 3; k++) {
    m.velocity[k] = s.velocity[0][k] - s.velocity[1][k];
    m.spin_i[k] = s.spin[0][k];
    m.spin_j[k] = s.spin[1][k];
  }
  return m;
}

/** What half_step keeps of each contact: rows of four numbers, and one more. */
GRAINSCOPE_INLINE void load_kept(const PairGroup &group, int first, Lanes *kept) {
  for (int row = 0; row < 8; row += LANES) load_rows([&](int k) { return group.history[k] + first + row; }, kept + row);
}
GRAINSCOPE_INLINE void store_kept(const PairGroup &group, LaneMask touching, int first, const Lanes *kept) {
  for (int row = 0; row < 8; row += LANES) {
    Lanes rows[LANES];
    transpose(kept + row, rows);
    for (int k = 0; k < LANES; k++)
      if (touching[k]) store(rows[k], group.history[k] + first + row);
  }
  for (int k = 0; k < LANES; k++)
    if (touching[k]) group.history[k][first + 8] = kept[8][k];
}

/** The velocity of the approach, if the law then takes another one. */
GRAINSCOPE_INLINE void keep_at_force(LaneMask touching, const Approach<Lanes> &a, GroupForces &kept) {
  kept.normal_at_force = pick(touching, a.normal_velocity, Lanes{});
  for (int k = 0; k < 3; k++) kept.tangential_at_force[k] = pick(touching, a.tangential_velocity[k], Lanes{});
}

/** Enters the velocity of the surfaces against each other into the approach. */
GRAINSCOPE_INLINE void enter_velocity(const Lanes *v, Approach<Lanes> &a) {
  a.normal_velocity = v[0] * a.normal[0] + v[1] * a.normal[1] + v[2] * a.normal[2];
  for (int k = 0; k < 3; k++) a.tangential_velocity[k] = v[k] - a.normal_velocity * a.normal[k];
}

/** Everything from the approach on. `lambda`: of the history from now on; what it was where null. `half`: the normal in
 *  the middle of the step with `time_level synchronized`; else null. */
template <class History, class Torques>
GRAINSCOPE_INLINE void push(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &g,
                            const GroupLaw &law, const Approach<Lanes> &a, const Place &place, const Lanes *lambda,
                            Torques torques, const Lanes *half, GroupForces *kept) {
  Coefficients<Lanes> c;
  coefficients(law, c);
  const Normal<Lanes> n = normal_force(*law.law, c, a);
  const Lanes limit = c.friction * absolute(n.force);
  Lanes history[4] = {}, *before = history + History::lambda;
  Friction<Lanes> f{};
  if (law.law->tangential == PairLaw::Tangential::history) {
    History::get(group, history);
    if (half) half_step::turn_spring(half, before);
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
    kept->synchronized = half != nullptr;
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

template <bool round, bool synchronized>
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
  Lanes v[3], half[3];
  const bool at_force = synchronized && kept && kept->springs;
  if (!synchronized || at_force) {
    Lanes turn_i[3], turn_j[3];
    outer(s.spin[0], place.arm, turn_i);
    outer(s.spin[1], arm_j, turn_j);
    for (int k = 0; k < 3; k++) v[k] = s.velocity[0][k] - s.velocity[1][k] + turn_i[k] - turn_j[k];
    enter_velocity(v, a);
  }
  if (at_force) keep_at_force(g.touching, a, *kept);
  if (synchronized) {
    Lanes remembered[half_step::kept_numbers];
    Moment<Lanes> now;
    for (int k = 0; k < 3; k++) {
      now.normal[k] = a.normal[k];
      now.arm_i[k] = place.arm[k];
      now.arm_j[k] = arm_j[k];
    }
    load_kept(group, law.law->kept, remembered);
    half_step::of_kept(now, false, motion_of(s), law.law->dt, remembered, half, v);
    store_kept(group, g.touching, law.law->kept, remembered);
    enter_velocity(v, a);
  }
  const Lanes *const turned = synchronized ? half : nullptr;

  if (round) {
    const Lanes lever[2] = {size_i - g.depth[0], size_j - g.depth[1]};
    for (int k = 0; k < 3; k++) place.set(xi, k, xi[k] - lever[0] * a.normal[k]);
    push<LambdaAndSpring>(grains, group, g, law, a, place, nullptr, LeverTorques{a.normal, lever}, turned, kept);
  } else {
    const bool friction = law.law->tangential != PairLaw::Tangential::off;
    const Lanes lambda = g.lambda - 0.5;
    push<LambdaAndSpring>(grains, group, g, law, a, place, &lambda, ArmTorques{place.arm, arm_j, friction}, turned,
                          kept);
  }
}

template <bool synchronized>
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
  Lanes xi[4], d[3], v[3], w[3], half_normal[3];
  Place place;
  load_rows([&](int k) { return grains.grains[group.i[k]].x; }, xi);
  for (int k = 0; k < 3; k++) {
    d[k] = -g.d[k];
    a.normal[k] = d[k] * inverse;
    v[k] = s.velocity[0][k] - s.velocity[1][k];
    w[k] = (lever_i * s.spin[0][k] + lever_j * s.spin[1][k]) * inverse;
    place.set(xi, k, xi[k] - lever_i * a.normal[k]);
  }
  const bool at_force = synchronized && kept && kept->springs;
  if (!synchronized || at_force) {
    a.normal_velocity = v[0] * a.normal[0] + v[1] * a.normal[1] + v[2] * a.normal[2];
    for (int k = 0; k < 3; k++) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      const Lanes along = a.normal_velocity * a.normal[k];
      a.tangential_velocity[k] = (v[k] - along) - (d[m] * w[l] - d[l] * w[m]);
    }
  }
  if (at_force) keep_at_force(g.touching, a, *kept);
  if (synchronized) {
    half_step::of_spheres(a.normal, d, radius_i, radius_j, motion_of(s), law.law->dt, half_normal, v);
    enter_velocity(v, a);
  }
  const Lanes lever[2] = {lever_i, lever_j};
  push<SpringAlone>(grains, group, g, law, a, place, nullptr, LeverTorques{a.normal, lever},
                    synchronized ? half_normal : nullptr, kept);
}

}

GRAINSCOPE_CLONES
void push_ellipsoids(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &g, const GroupLaw &law,
                     GroupForces *kept) {
  push_ellipsoids_of<false, false>(grains, group, g, law, kept);
}
GRAINSCOPE_CLONES
void push_ellipsoids_synchronized(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &g,
                                  const GroupLaw &law, GroupForces *kept) {
  push_ellipsoids_of<false, true>(grains, group, g, law, kept);
}
GRAINSCOPE_CLONES
void push_round(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &g, const GroupLaw &law,
                GroupForces *kept) {
  push_ellipsoids_of<true, false>(grains, group, g, law, kept);
}
GRAINSCOPE_CLONES
void push_round_synchronized(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &g,
                             const GroupLaw &law, GroupForces *kept) {
  push_ellipsoids_of<true, true>(grains, group, g, law, kept);
}
GRAINSCOPE_CLONES
void push_spheres(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &g, const GroupLaw &law,
                  GroupForces *kept) {
  push_spheres_of<false>(grains, group, g, law, kept);
}
GRAINSCOPE_CLONES
void push_spheres_synchronized(const PackedGrains &grains, const PairGroup &group, const GroupGeometry &g,
                               const GroupLaw &law, GroupForces *kept) {
  push_spheres_of<true>(grains, group, g, law, kept);
}

}

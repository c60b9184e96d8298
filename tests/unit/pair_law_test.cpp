// SPDX-License-Identifier: GPL-2.0-or-later
#include "half_step.h"
#include "off_place.h"
#include "packed_pairs.h"
#include "sphere_contact.h"
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

using namespace packed_pairs;
using Eigen::Vector3d;
using Vector = Eigen::Map<const Vector3d>;

namespace {

constexpr int TYPES = 3;

/** Constants of each pair of types, as LIGGGHTS calls them. */
struct Material {
  double Yeff[TYPES][TYPES], Geff[TYPES][TYPES], betaeff[TYPES][TYPES], coeffRestLog[TYPES][TYPES], k_n[TYPES][TYPES],
      k_t[TYPES][TYPES], gamma_n[TYPES][TYPES], gamma_t[TYPES][TYPES], coeffFrict[TYPES][TYPES];

  explicit Material(RandomPairs &random) {
    for (int i = 0; i < TYPES; i++)
      for (int j = 0; j < TYPES; j++) {
        Yeff[i][j] = random.uniform(50.0, 100.0);
        Geff[i][j] = random.uniform(10.0, 20.0);
        coeffRestLog[i][j] = std::log(random.uniform(0.2, 0.9));
        betaeff[i][j] = coeffRestLog[i][j] / std::sqrt(coeffRestLog[i][j] * coeffRestLog[i][j] + M_PI * M_PI);
        k_n[i][j] = random.uniform(50.0, 100.0);
        k_t[i][j] = random.uniform(20.0, 50.0);
        gamma_n[i][j] = random.uniform(2.0, 5.0);
        gamma_t[i][j] = random.uniform(1.0, 5.0);
        coeffFrict[i][j] = random.uniform(0.1, 2.0);
      }
  }

  /** As PairLaw keeps them. */
  PairLaw::Terms terms(const PairLaw &law, int i, int j) const {
    const double sqrtFiveOverSix = 0.91287092917527685576161630466800355658790782499663875, l = coeffRestLog[i][j],
                 Y = Yeff[i][j];
    switch (law.normal) {
      case PairLaw::Normal::hertz:
        return {{2. * Y, 8. * Geff[i][j], 4. / 3. * Y, -2. * sqrtFiveOverSix * betaeff[i][j]}, coeffFrict[i][j], {}};
      case PairLaw::Normal::hooke: return {{Y, l * l, l * l + M_PI * M_PI, 0.0}, coeffFrict[i][j], {}};
      default: return {{k_n[i][j], k_t[i][j], gamma_n[i][j], gamma_t[i][j]}, coeffFrict[i][j], {}};
    }
  }
};

/** What LIGGGHTS makes of one contact: its SurfacesIntersectData, as far as the laws go. */
struct Single {
  Vector3d en, vtr, point, arm[2], shear, before, uncut, force, torque[2];
  double deltan, reff, meff, vn, cr[2], kn, kt, gamman, gammat, Fn, limit, length;
  bool round, cut;
};

/** Normal models of LIGGGHTS (normal_model_*.h), line by line. */
void normal_model(const PairLaw &law, const Material &m, int i, int j, Single &s) {
  switch (law.normal) {
    case PairLaw::Normal::hertz: {
      const double sqrtval = std::sqrt(s.reff * s.deltan), Sn = 2. * m.Yeff[i][j] * sqrtval,
                   St = 8. * m.Geff[i][j] * sqrtval,
                   sqrtFiveOverSix = 0.91287092917527685576161630466800355658790782499663875;
      s.kn = 4. / 3. * m.Yeff[i][j] * sqrtval;
      s.kt = St;
      s.gamman = -2. * sqrtFiveOverSix * m.betaeff[i][j] * std::sqrt(Sn * s.meff);
      s.gammat = -2. * sqrtFiveOverSix * m.betaeff[i][j] * std::sqrt(St * s.meff);
      break;
    }
    case PairLaw::Normal::hooke: {
      const double sqrtval = std::sqrt(s.reff), charVel = law.characteristic_speed, l = m.coeffRestLog[i][j],
                   squared = l * l;
      s.kn = 16. / 15. * sqrtval * (m.Yeff[i][j]) *
             std::pow(15. * s.meff * charVel * charVel / (16. * sqrtval * m.Yeff[i][j]), 0.2);
      s.kt = s.kn;
      if (law.two_sevenths) s.kt *= 0.285714286;
      s.gamman = std::sqrt(4. * s.meff * s.kn * squared / (squared + M_PI * M_PI));
      s.gammat = s.gamman;
      break;
    }
    case PairLaw::Normal::hertz_stiffness: {
      const double polyhertz = std::sqrt(s.reff * s.deltan);
      s.kn = polyhertz * m.k_n[i][j];
      s.kt = polyhertz * m.k_t[i][j];
      s.gamman = polyhertz * s.meff * m.gamma_n[i][j];
      s.gammat = polyhertz * s.meff * m.gamma_t[i][j];
      break;
    }
    case PairLaw::Normal::hooke_stiffness:
      s.kn = m.k_n[i][j];
      s.kt = m.k_t[i][j];
      s.gamman = law.absolute_damping ? m.gamma_n[i][j] : s.meff * m.gamma_n[i][j];
      s.gammat = law.absolute_damping ? m.gamma_t[i][j] : s.meff * m.gamma_t[i][j];
  }
  if (!law.tangential_damping) s.gammat = 0.0;
  const double damping = -s.gamman * s.vn, contact = s.kn * s.deltan;
  s.Fn = damping + contact;
  if (law.limits_force && s.Fn < 0.0) s.Fn = 0.0;
}

/** tangential_model_*.h; returns the force on i. */
Vector3d tangential_model(const PairLaw &law, Single &s) {
  s.cut = false;
  s.before = s.uncut = Vector3d::Zero();
  s.length = 0.0;
  if (law.tangential == PairLaw::Tangential::off) return Vector3d::Zero();
  if (law.tangential == PairLaw::Tangential::no_history) {
    s.length = std::sqrt(s.vtr[0] * s.vtr[0] + s.vtr[1] * s.vtr[1] + s.vtr[2] * s.vtr[2]);
    s.cut = s.limit < s.gammat * s.length;
    const double gamma = s.cut ? s.limit / s.length : s.gammat;
    return -gamma * s.vtr;
  }
  s.before = s.shear;
  s.shear += s.vtr * law.dt;
  const double rsht = s.shear[0] * s.en[0] + s.shear[1] * s.en[1] + s.shear[2] * s.en[2];
  s.shear -= rsht * s.en;
  s.uncut = s.shear;
  s.length = std::sqrt(s.shear[0] * s.shear[0] + s.shear[1] * s.shear[1] + s.shear[2] * s.shear[2]);
  Vector3d ft = -(s.kt * s.shear);
  const double elastic = s.kt * s.length;
  s.cut = elastic > s.limit;
  if (!s.cut) return ft - s.gammat * s.vtr;
  ft *= s.limit / elastic;
  for (int k = 0; k < 3; k++) s.shear[k] = -ft[k] / s.kt;
  return ft;
}

/** Which case of all that a law can be. */
struct Case {
  Grains kind;
  PairLaw::Normal normal;
  PairLaw::Tangential tangential;
  int options;  // bits
  bool frozen, one_type;
};

PairLaw law_of(const Case &c) {
  PairLaw law;
  law.normal = c.normal;
  law.tangential = c.tangential;
  law.tangential_damping = !(c.options & 1);
  law.limits_force = c.options & 2;
  law.two_sevenths = c.options & 4;
  law.absolute_damping = c.options & 4;
  law.curvature_limit = c.options & 8 ? 0.7 : 0.0;
  law.characteristic_speed = 1.3;
  law.dt = 0.05;
  law.types = c.one_type ? 1 : TYPES;
  return law;
}

/** One scene and one law; groups of pairs, and the same one by one. */
struct Bench {
  Case which;
  Scene scene;
  Material material;
  PairLaw law;
  std::vector<double> history = std::vector<double>(4 * LANES);
  int touching = 0, apart = 0, cut = 0, limited = 0, ghosts = 0;

  Bench(const Case &c, unsigned long seed)
      : which(c), scene(seed, c.kind, 14, 10, 3.2), material(scene.random), law(law_of(c)) {
    for (int i = 0; i < law.types; i++)
      for (int j = 0; j < law.types; j++) law.terms.push_back(material.terms(law, i, j));
    if (c.one_type) std::fill(scene.types.begin(), scene.types.end(), 0);
  }

  int type(int grain) const { return scene.types[grain]; }

  GroupLaw law_of_group(const PairGroup &group) const {
    GroupLaw result{};
    result.law = &law;
    result.frozen = which.frozen;
    for (int k = 0; k < LANES; k++) {
      result.terms[k] = which.one_type && k ? nullptr : &law.terms[type(group.i[k]) * law.types + type(group.j[k])];
      result.frozen_i[k] = scene.frozen[group.i[k]] ? -1 : 0;
      result.frozen_j[k] = scene.frozen[group.j[k]] ? -1 : 0;
    }
    return result;
  }

  void meet(const PairGroup &group, GroupGeometry &g) {
    SolverTally tally;
    if (which.kind == Grains::spheres) meet_spheres(scene.packed(), group, g);
    else (which.kind == Grains::round ? meet_round : meet_spheroids)(scene.packed(), group, g, tally);
    if (which.kind == Grains::spheroids) g.touching = g.touching & ~g.alone;
  }

  void push(const PairGroup &group, const GroupGeometry &g, GroupForces *kept) {
    const auto kernel = which.kind == Grains::spheres ? push_spheres
                        : which.kind == Grains::round ? push_round
                                                      : push_ellipsoids;
    kernel(scene.packed(), group, g, law_of_group(group), kept);
  }

  void push_synchronized(const PairGroup &group, const GroupGeometry &g, GroupForces &kept) {
    const auto kernel = which.kind == Grains::spheres ? push_spheres_synchronized
                        : which.kind == Grains::round ? push_round_synchronized
                                                      : push_ellipsoids_synchronized;
    kernel(scene.packed(), group, g, law_of_group(group), &kept);
  }

  /** `surface default`: surface_model_default.h and pair_gran_base.h. */
  void sphere_surface(const PackedGrain &a, const PackedGrain &b, Single &s) const {
    const Vector3d delta = Vector(a.x) - Vector(b.x), vr = Vector(a.velocity) - Vector(b.velocity);
    const double r = std::sqrt(delta[0] * delta[0] + delta[1] * delta[1] + delta[2] * delta[2]), rinv = 1.0 / r;
    s.en = delta * rinv;
    s.vn = vr[0] * s.en[0] + vr[1] * s.en[1] + vr[2] * s.en[2];
    s.deltan = (a.size + b.size) - r;
    s.cr[0] = a.size - 0.5 * s.deltan;
    s.cr[1] = b.size - 0.5 * s.deltan;
    const Vector3d wr = (s.cr[0] * Vector(a.spin) + s.cr[1] * Vector(b.spin)) * rinv, vt = vr - s.vn * s.en;
    s.vtr[0] = vt[0] - (delta[2] * wr[1] - delta[1] * wr[2]);
    s.vtr[1] = vt[1] - (delta[0] * wr[2] - delta[2] * wr[0]);
    s.vtr[2] = vt[2] - (delta[1] * wr[0] - delta[0] * wr[1]);
    s.reff = a.size * b.size / (a.size + b.size);
    s.round = true;
    s.point = Vector(a.x) - s.cr[0] * s.en;
  }

  /** `surface ellipsoid`: contact point and normal are the solver's. */
  void ellipsoid_surface(const PackedGrain &a, const PackedGrain &b, const EllipsoidContact &c, Single &s) const {
    s.en = -Vector(c.normal);
    s.point = Vector(a.x) + Vector(c.point);
    s.deltan = c.depth[0] + c.depth[1];
    s.reff = a.size * b.size / (a.size + b.size);
    s.round = which.kind == Grains::round;
    if (!s.round && law.curvature_limit > 0.0)
      s.reff = std::min(1.0 / (c.curvature[0] + c.curvature[1]), s.reff * law.curvature_limit);
    s.arm[0] = s.point - Vector(a.x);
    s.arm[1] = s.point - Vector(b.x);
    const Vector3d v =
        Vector(a.velocity) - Vector(b.velocity) + Vector(a.spin).cross(s.arm[0]) - Vector(b.spin).cross(s.arm[1]);
    s.vn = v[0] * s.en[0] + v[1] * s.en[1] + v[2] * s.en[2];
    s.vtr = v - s.vn * s.en;
    if (!s.round) return;
    s.cr[0] = a.size - c.depth[0];
    s.cr[1] = b.size - c.depth[1];
    s.point = Vector(a.x) - s.cr[0] * s.en;
  }

  /** One pair; false if it does not touch. */
  bool single(int i, int j, double *h, Single &s) {
    const PackedGrain &a = scene.grains[i], &b = scene.grains[j];
    const Vector3d d = Vector(b.x) - Vector(a.x);
    const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], reach = a.reach + b.reach;
    if (!(square < reach * reach)) return false;
    double *spring = h + (which.kind != Grains::spheres);
    if (which.kind == Grains::spheres) {
      sphere_surface(a, b, s);
    } else {
      const double start = *h == 0.0 ? 0.0 : *h + 0.5;
      const EllipsoidContact c = which.kind == Grains::round
                                     ? sphere_contact(a.axis[0], b.axis[0], d.data(), square)
                                     : ellipsoid_contact(scene.bodies[i], scene.bodies[j], d.data(), start);
      if (!c.touching || c.fallback || c.steps > 6) return false;
      ellipsoid_surface(a, b, c, s);
      if (which.kind == Grains::spheroids) *h = c.lambda - 0.5;
    }
    s.meff = a.mass * b.mass / (a.mass + b.mass);
    if (which.frozen && scene.frozen[i]) s.meff = b.mass;
    if (which.frozen && scene.frozen[j]) s.meff = a.mass;
    normal_model(law, material, type(i), type(j), s);
    s.limit = material.coeffFrict[type(i)][type(j)] * std::fabs(s.Fn);
    s.shear = Vector(spring);
    const Vector3d ft = tangential_model(law, s), fn = s.Fn * s.en;
    if (law.tangential == PairLaw::Tangential::history) std::copy_n(s.shear.data(), 3, spring);
    s.force = fn + ft;
    for (int side = 0; side < 2; side++)
      s.torque[side] = s.round ? Vector3d(-s.cr[side] * s.en.cross(ft))
                       : side  ? Vector3d(s.arm[1].cross(-fn) + s.arm[1].cross(-ft))
                               : Vector3d(s.arm[0].cross(fn) + s.arm[0].cross(ft));
    return true;
  }

  void expect_kept(const GroupForces &kept, int k, const Single &s, const double *h) const {
    for (int l = 0; l < 3; l++) {
      ASSERT_EQ(kept.normal[l][k], s.en[l]);
      ASSERT_EQ(kept.force[l][k], s.force[l]);
      ASSERT_EQ(kept.tangential_velocity[l][k], s.vtr[l]);
      ASSERT_EQ(kept.point[l][k], s.point[l]);
    }
    ASSERT_EQ(kept.overlap[k], s.deltan);
    ASSERT_EQ(kept.normal_velocity[k], s.vn);
    ASSERT_EQ(kept.law_force[k], s.Fn);
    ASSERT_EQ(kept.kn[k], s.kn);
    ASSERT_EQ(kept.kt[k], s.kt);
    ASSERT_EQ(kept.gamma_n[k], s.gamman);
    ASSERT_EQ(kept.gamma_t[k], s.gammat);
    ASSERT_EQ(kept.limit[k], s.limit);
    ASSERT_EQ(bool(kept.cut[k]), s.cut);
    if (law.tangential == PairLaw::Tangential::off) return;
    ASSERT_EQ(kept.length[k], s.length);
    if (law.tangential != PairLaw::Tangential::history) return;
    for (int l = 0; l < 3; l++) {
      ASSERT_EQ(kept.before[l][k], s.before[l]);
      ASSERT_EQ(kept.uncut[l][k], s.uncut[l]);
      ASSERT_EQ(kept.after[l][k], h[l]);
    }
  }

  /** A group, and the same pairs one by one: forces, springs and what is kept are equal to the last bit. */
  void compare(int size, bool keeps) {
    for (int k = 0; k < 4 * LANES; k++)
      history[k] = k % 4 || which.kind == Grains::spheres ? 0.3 * scene.random.normal()
                   : scene.random.uniform() < 0.5         ? 0.0
                                                          : scene.random.uniform(-0.3, 0.3);
    const PairGroup group = scene.group(size, history);
    std::vector<double> alone = history;
    std::vector<PackedForce> sum = scene.forces;
    OffPlace<GroupGeometry> geometry;
    OffPlace<GroupForces> forces;
    GroupGeometry &g = geometry.here;
    GroupForces &kept = forces.here;
    meet(group, g);
    push(group, g, keeps ? &kept : nullptr);
    for (int k = 0; k < size; k++) {
      Single s;
      double *h = &alone[4 * k];
      const bool touches = single(group.i[k], group.j[k], h, s);
      ASSERT_EQ(bool(g.touching[k]), touches);
      apart += !touches;
      if (!touches) continue;
      touching++;
      cut += s.cut;
      limited += law.limits_force && s.Fn == 0.0;
      const bool ghost = group.j[k] >= scene.own;
      ghosts += ghost;
      for (int l = 0; l < 3; l++) {
        sum[group.i[k]].force[l] += s.force[l];
        sum[group.i[k]].torque[l] += s.torque[0][l];
        if (ghost) continue;
        sum[group.j[k]].force[l] -= s.force[l];
        sum[group.j[k]].torque[l] += s.torque[1][l];
      }
      if (keeps) expect_kept(kept, k, s, h + (which.kind != Grains::spheres));
    }
    ASSERT_EQ(history, alone);
    for (int i = 0; i < scene.own; i++)
      for (int l = 0; l < 3; l++) {
        ASSERT_EQ(scene.forces[i].force[l], sum[i].force[l]);
        ASSERT_EQ(scene.forces[i].torque[l], sum[i].torque[l]);
      }
  }
};

const char *name_of(Grains kind) {
  return kind == Grains::spheres ? "spheres" : kind == Grains::round ? "round" : "spheroids";
}

constexpr PairLaw::Normal NORMALS[] = {PairLaw::Normal::hertz, PairLaw::Normal::hooke, PairLaw::Normal::hertz_stiffness,
                                       PairLaw::Normal::hooke_stiffness};
constexpr PairLaw::Tangential TANGENTIALS[] = {PairLaw::Tangential::off, PairLaw::Tangential::no_history,
                                               PairLaw::Tangential::history};
constexpr Grains KINDS[] = {Grains::spheres, Grains::round, Grains::spheroids};

}

/** Every law and every option of it, with and without frozen grains and several types. */
TEST(pair_law, is_that_of_the_host_to_the_last_bit) {
  for (Grains kind : KINDS) {
    int touching = 0, apart = 0, cut = 0, limited = 0, ghosts = 0;
    unsigned long seed = 100;
    for (PairLaw::Normal normal : NORMALS)
      for (PairLaw::Tangential tangential : TANGENTIALS)
        for (int options = 0; options < 16; options++)
          for (int way = 0; way < 4; way++) {
            SCOPED_TRACE(testing::Message() << name_of(kind) << ", normal " << int(normal) << ", tangential "
                                            << int(tangential) << ", options " << options << ", way " << way);
            Bench bench({kind, normal, tangential, options, (way & 1) != 0, (way & 2) != 0}, seed++);
            for (int n = 0; n < 20; n++) {
              bench.compare(1 + n % LANES, n % 3 == 0);
              if (HasFatalFailure()) return;
            }
            touching += bench.touching;
            apart += bench.apart;
            cut += bench.cut;
            limited += bench.limited;
            ghosts += bench.ghosts;
          }
    EXPECT_GT(touching, 10000);
    EXPECT_GT(apart, 3000);
    EXPECT_GT(cut, 1000);
    EXPECT_LT(cut, touching / 2);
    EXPECT_GT(limited, 100);
    EXPECT_GT(ghosts, 1000);
  }
}

/** With `time_level synchronized` forces are kept beside the velocity that the host's law takes: to the last bit. */
TEST(pair_law, synchronized_keeps_the_velocity_that_forces_work_with) {
  for (Grains kind : KINDS)
    for (PairLaw::Tangential tangential : {PairLaw::Tangential::no_history, PairLaw::Tangential::history}) {
      int touching = 0, apart = 0;
      Bench bench({kind, PairLaw::Normal::hertz, tangential, 0, false, false}, 11);
      bench.law.kept = 4;
      for (int n = 0; n < 400; n++) {
        PairGroup group = bench.scene.group(1 + n % LANES, bench.history);
        double history[LANES][4 + half_step::kept_numbers] = {};
        for (int k = 0; k < LANES; k++) {
          std::fill_n(history[k] + 4, 3, std::sqrt(1.0 / 3.0));  // a normal: about half of the contacts go on
          group.history[k] = history[std::min(k, group.size - 1)];
        }
        OffPlace<GroupGeometry> geometry;
        OffPlace<GroupForces> host, synchronized;
        bench.meet(group, geometry.here);
        bench.push(group, geometry.here, &host.here);
        bench.push_synchronized(group, geometry.here, synchronized.here);
        for (int k = 0; k < LANES; k++) {
          touching += geometry.here.touching[k] != 0;
          apart += std::fabs(host.here.normal_velocity[k] - synchronized.here.normal_velocity[k]) > 1e-3;
          ASSERT_EQ(host.here.working_normal()[k], host.here.normal_velocity[k]);
          ASSERT_EQ(synchronized.here.working_normal()[k], host.here.normal_velocity[k]);
          for (int l = 0; l < 3; l++)
            ASSERT_EQ(synchronized.here.working_tangential()[l][k], host.here.tangential_velocity[l][k]);
        }
      }
      EXPECT_GT(touching, 300);
      EXPECT_GT(apart, touching / 4);
    }
}

/** Of a group of which nothing touches nothing changes. */
TEST(pair_law, leaves_alone_what_does_not_touch) {
  for (Grains kind : KINDS)
    for (PairLaw::Tangential tangential : TANGENTIALS) {
      Bench bench({kind, PairLaw::Normal::hertz, tangential, 0, false, false}, 7);
      for (double &h : bench.history) h = bench.scene.random.uniform(-0.3, 0.3);
      const PairGroup group = bench.scene.group(3, bench.history);
      GroupGeometry g;
      bench.meet(group, g);
      g.touching = LaneMask{};
      const std::vector<double> history = bench.history;
      const std::vector<PackedForce> before = bench.scene.forces;
      bench.push(group, g, nullptr);
      EXPECT_EQ(bench.history, history);
      for (std::size_t i = 0; i < before.size(); i++)
        for (int l = 0; l < 4; l++) {
          EXPECT_EQ(bench.scene.forces[i].force[l], before[i].force[l]);
          EXPECT_EQ(bench.scene.forces[i].torque[l], before[i].torque[l]);
        }
    }
}

/** Forces of two grains are opposite to the last bit; their moments about any point cancel but for rounding. */
TEST(pair_law, gives_two_grains_opposite_forces_and_moments) {
  for (Grains kind : KINDS)
    for (PairLaw::Normal normal : NORMALS)
      for (PairLaw::Tangential tangential : TANGENTIALS) {
        int touching = 0;
        for (int n = 0; n < 200; n++) {
          Bench bench({kind, normal, tangential, 0, false, false}, 1000 + n);
          bench.scene.own = 14;
          bench.scene.forces.assign(15, PackedForce{});
          for (double &h : bench.history) h = 0.1 * bench.scene.random.normal();
          const PairGroup group = bench.scene.group(1, bench.history);
          GroupGeometry g;
          bench.meet(group, g);
          if (!g.touching[0]) continue;
          touching++;
          bench.push(group, g, nullptr);
          const Vector3d about(0.3, -2.0, 1.1);
          Vector3d moment = Vector3d::Zero();
          double scale = 0.0;
          for (int grain : {group.i[0], group.j[0]}) {
            const Vector3d f = Vector(bench.scene.forces[grain].force), t = Vector(bench.scene.forces[grain].torque),
                           arm = Vector(bench.scene.grains[grain].x) - about;
            moment += t + arm.cross(f);
            scale += f.norm() * (arm.norm() + 1.0);
          }
          for (int l = 0; l < 3; l++)
            EXPECT_EQ(bench.scene.forces[group.i[0]].force[l], -bench.scene.forces[group.j[0]].force[l]);
          EXPECT_LE(moment.norm(), 1e-14 * scale);
        }
        EXPECT_GT(touching, 50);
      }
}

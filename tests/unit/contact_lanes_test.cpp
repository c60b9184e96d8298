// SPDX-License-Identifier: GPL-2.0-or-later
/** Sums over contacts that come four at a time, against those of the same contacts one by one. */
#include "grain_power.h"
#include "loss_lanes.h"
#include "off_place.h"
#include "stress_lanes.h"
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <random>
#include <vector>

using namespace grainscope;
using Eigen::Vector3d;

namespace {

constexpr int OWN = 7, ALL = 12;  // grains, and with ghosts
constexpr double DT = 0.01;

class RandomContacts {
 public:
  explicit RandomContacts(TangentialLaw tangential, double friction = 0.4, bool limits_force = false) {
    law_.tangential = tangential;
    law_.elastic = true;
    law_.limits_force = limits_force;
    friction_ = friction;
    for (int k = 0; k < 3 * ALL; k++) shifts[k] = k < 3 * OWN ? 0.0 : std::round(uniform(-1.5, 1.5));
    edges << 0.3, 0.7, -0.2, 0, 0.1, 0.5, 0, 0, -0.4;
    for (int k = 0; k < ALL; k++) mask[k] = k % 5 ? 3 : 1;
  }

  /** Some of four pairs touch, some lanes may be idle. */
  template <class UseLanes, class UseContact>
  void many(const UseLanes &lanes, const UseContact &contact) {
    for (int size = 1; size <= LANES; size++)
      for (int touching = 0; touching < 1 << size; touching++)
        for (int turn = 0; turn < 20; turn++) {
          group_ = PairGroup();
          geometry_.here = GroupGeometry();
          forces_.here = GroupForces();
          group_.size = size;
          std::vector<Contact> contacts;
          for (int k = 0; k < LANES; k++) {
            group_.i[k] = whole(OWN);
            do group_.j[k] = whole(ALL);
            while (group_.j[k] == group_.i[k]);
            if (touching >> k & 1) contacts.push_back(touch(k));
          }
          lanes(ContactLanes{group_, geometry_.here, forces_.here, law_, DT});
          for (const Contact &c : contacts) contact(c);
        }
  }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Vector3d vector() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }

  double shifts[3 * ALL];
  int mask[ALL];
  Eigen::Matrix3d edges;

 private:
  std::mt19937 engine_{7};
  ContactLaw law_;
  double friction_;
  PairGroup group_;
  OffPlace<GroupGeometry> geometry_;
  OffPlace<GroupForces> forces_;

  int whole(int end) { return std::uniform_int_distribution<int>(0, end - 1)(engine_); }

  Contact touch(int k) {
    Contact c;
    ContactMotion &m = c.motion.emplace();
    const bool ghost = group_.j[k] >= OWN, spring = law_.tangential == TangentialLaw::spring;
    c.i = group_.i[k];
    c.partner = PartnerGrain{group_.j[k], ghost};
    c.law = &law_;
    c.weight = ghost ? 0.5 : 1.0;
    c.branch = vector();
    c.normal = vector().normalized();
    c.overlap = uniform(0.0, 0.1);
    m.arm = vector();
    m.point = vector();
    m.normal_velocity = uniform(-1, 1);
    m.tangential_velocity = vector();
    m.tangential_velocity -= m.tangential_velocity.dot(c.normal) * c.normal;
    m.normal_stiffness = uniform(50, 100);
    m.tangential_stiffness = uniform(50, 100);
    m.damping_coefficient = uniform(1, 10);
    const double gamma_t = uniform(0, 1) < 0.3 ? 0.0 : uniform(1, 10), elastic = m.normal_stiffness * c.overlap;
    double force = elastic - m.damping_coefficient * m.normal_velocity;
    m.normal_damping = -m.damping_coefficient * m.normal_velocity;
    if (law_.limits_force && force < 0.0) {
      force = 0.0;
      m.normal_damping = -elastic;
    }
    c.friction_limit = friction_ * std::fabs(force);
    Vector3d s = vector();
    s -= s.dot(c.normal) * c.normal;
    if (!spring) s = m.tangential_velocity;
    const double rest = spring ? m.tangential_stiffness * s.norm() : gamma_t * s.norm();
    c.sliding = law_.tangential != TangentialLaw::none && rest > c.friction_limit;
    Vector3d tangential = Vector3d::Zero();
    if (c.sliding) tangential = -c.friction_limit * s.normalized();
    else if (spring) tangential = -m.tangential_stiffness * s - gamma_t * m.tangential_velocity;
    else if (law_.tangential == TangentialLaw::viscous) tangential = -gamma_t * s;
    if (c.sliding) c.slip = spring ? s.norm() - c.friction_limit / m.tangential_stiffness : s.norm() * DT;
    m.tangential_damping = law_.tangential == TangentialLaw::none ? 0.0 : gamma_t;
    m.damped = !c.sliding && m.tangential_damping > 0.0;
    c.force = force * c.normal + tangential;
    c.normal_force = c.force.dot(c.normal);
    c.tangential_force = c.friction_force = c.force - c.normal_force * c.normal;

    geometry_.here.touching[k] = -1;
    GroupForces &f = forces_.here;
    f.weight[k] = c.weight;
    f.overlap[k] = c.overlap;
    f.law_force[k] = force;
    f.kn[k] = m.normal_stiffness;
    f.kt[k] = m.tangential_stiffness;
    f.gamma_n[k] = m.damping_coefficient;
    f.gamma_t[k] = gamma_t;
    f.limit[k] = c.friction_limit;
    f.length[k] = s.norm();
    f.cut[k] = c.sliding ? -1 : 0;
    f.normal_velocity[k] = m.normal_velocity;
    for (int l = 0; l < 3; l++) {
      geometry_.here.d[l][k] = -c.branch[l];
      f.normal[l][k] = c.normal[l];
      f.force[l][k] = c.force[l];
      f.tangential_velocity[l][k] = m.tangential_velocity[l];
      f.arm[l][k] = m.arm[l];
    }
    return c;
  }
};

std::vector<RandomContacts> cases() {
  return {RandomContacts(TangentialLaw::spring), RandomContacts(TangentialLaw::spring, 0.0),
          RandomContacts(TangentialLaw::spring, 5.0, true), RandomContacts(TangentialLaw::viscous),
          RandomContacts(TangentialLaw::none)};
}

/** Relative to the largest, of sums of some hundred numbers. */
template <class Numbers>
void expect_near(const Numbers &a, const Numbers &b) {
  double largest = 0.0;
  for (double x : b) largest = std::max(largest, std::fabs(x));
  for (std::size_t k = 0; k < b.size(); k++) EXPECT_NEAR(a[k], b[k], 1e-13 * largest) << k;
}

}

TEST(contact_lanes, stress_is_that_of_single_contacts) {
  for (RandomContacts &random : cases()) {
    StressSums single, sums;
    OffPlace<StressLanes> lanes;
    random.many([&](const ContactLanes &c) { lanes.here.add(c, sums); }, [&](const Contact &c) { single.add(c); });
    lanes.here.move_to(sums);
    expect_near(sums.sums, single.sums);
    EXPECT_EQ(sums.largest_overlap, single.largest_overlap);
    for (int k = 18; k < 21; k++) EXPECT_EQ(sums.sums[k], single.sums[k]);
    lanes.here.move_to(sums);  // what was moved is gone
    expect_near(sums.sums, single.sums);
  }
}

TEST(contact_lanes, losses_are_those_of_single_contacts) {
  for (LossSums::Of of : {LossSums::Of::powers, LossSums::Of::slip, LossSums::Of::contacts})
    for (RandomContacts &random : cases()) {
      LossSums single, sums;
      OffPlace<LossLanes> lanes;
      single.of = sums.of = of;
      random.many([&](const ContactLanes &c) { lanes.here.add(c, sums); }, [&](const Contact &c) { single.add(c); });
      lanes.here.move_to(sums);
      expect_near(sums.all, single.all);
    }
}

TEST(contact_lanes, damping_powers_are_those_of_single_contacts) {
  for (int bit : {0, 2})
    for (RandomContacts &random : cases()) {
      GrainPower normal, tangential, single_normal, single_tangential;
      for (GrainPower *one : {&normal, &tangential, &single_normal, &single_tangential}) one->reset(OWN);
      const GrainPower::Images images{random.edges, random.shifts, random.mask, bit};
      random.many([&](const ContactLanes &c) { GrainPower::add_damping(c, images, normal, tangential); },
                  [&](const Contact &c) {
                    const ContactMotion &m = *c.motion;
                    Vector3d image = Vector3d::Zero();
                    if (c.ghost() && (random.mask[c.j()] & bit))
                      image = random.edges * Eigen::Map<const Vector3d>(random.shifts + 3 * c.j());
                    const auto add = [&](GrainPower &to, const Vector3d &force) {
                      to.add(c, force, m.arm, m.arm + c.branch, image);
                    };
                    add(single_normal, m.normal_damping * c.normal);
                    if (m.damped) add(single_tangential, -m.tangential_damping * m.tangential_velocity);
                  });
      double v[3 * OWN], omega[3 * OWN];
      for (double &x : v) x = random.uniform(-1, 1);
      for (double &x : omega) x = random.uniform(-1, 1);
      expect_near(std::vector<double>{normal.power(v, omega), tangential.power(v, omega)},
                  std::vector<double>{single_normal.power(v, omega), single_tangential.power(v, omega)});
    }
}

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_RANDOM_CONTACTS_H
#define GRAINSCOPE_RANDOM_CONTACTS_H

#include "contact_lanes.h"
#include "off_place.h"
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

/** Contacts that come four at a time, and the same contacts one by one. */
namespace random_contacts {

using namespace grainscope;
using Eigen::Vector3d;

constexpr int OWN = 7, ALL = 12;  // grains, and with ghosts
constexpr double DT = 0.01;

class RandomContacts {
 public:
  explicit RandomContacts(TangentialLaw tangential, double friction = 0.4, bool limits_force = false,
                          double exponent = 1.5) {
    law_.exponent = exponent;
    law_.tangential = tangential;
    law_.elastic = true;
    law_.limits_force = limits_force;
    friction_ = friction;
    for (int k = 0; k < 3 * ALL; k++) shifts[k] = k < 3 * OWN ? 0.0 : std::round(uniform(-1.5, 1.5));
    edges << 0.3, 0.7, -0.2, 0, 0.1, 0.5, 0, 0, -0.4;
    for (int k = 0; k < ALL; k++) mask[k] = k % 5 ? 3 : 1;
  }

  /** `time_level synchronized`: forces work with another velocity than that of the law. */
  RandomContacts synchronized() && {
    law_.synchronized = true;
    return std::move(*this);
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
          past_.here = PastLanes();
          group_.size = size;
          std::vector<Contact> contacts;
          for (int k = 0; k < LANES; k++) {
            group_.i[k] = whole(OWN);
            do group_.j[k] = whole(ALL);
            while (group_.j[k] == group_.i[k]);
            if (touching >> k & 1) contacts.push_back(touch(k));
          }
          lanes(ContactLanes{group_, geometry_.here, forces_.here, law_, DT, &past_.here});
          for (const Contact &c : contacts) contact(c);
        }
  }
  const ContactLaw &law() const { return law_; }
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
  OffPlace<PastLanes> past_;

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
    if (law_.synchronized) {
      const Vector3d u = vector();
      c.at_force = ContactVelocity{u.dot(c.normal), u - u.dot(c.normal) * c.normal};
    }
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
    f.synchronized = law_.synchronized;
    const ContactVelocity working = c.working_velocity();
    f.normal_at_force[k] = working.normal;
    for (int l = 0; l < 3; l++) {
      geometry_.here.d[l][k] = -c.branch[l];
      f.normal[l][k] = c.normal[l];
      f.force[l][k] = c.force[l];
      f.tangential_velocity[l][k] = m.tangential_velocity[l];
      f.tangential_at_force[l][k] = working.tangential[l];
      f.arm[l][k] = m.arm[l];
    }
    remember(k, spring ? s : Vector3d::Zero(), c);
    return c;
  }

  /** What `ledger on` tells of it; s: the spring before it was cut. */
  void remember(int k, const Vector3d &s, Contact &c) {
    const double stiffness = c.motion->tangential_stiffness;
    ContactSpring &spring = c.spring.emplace();
    if (law_.tangential == TangentialLaw::spring) {
      spring.before = vector();
      spring.after = c.sliding ? Vector3d(c.friction_limit / stiffness * s.normalized()) : s;
      spring.cut = s - spring.after;
    }
    GroupForces &f = forces_.here;
    for (int l = 0; l < 3; l++) {
      f.before[l][k] = spring.before[l];
      f.after[l][k] = spring.after[l];
      f.uncut[l][k] = s[l];
    }
    if (uniform(0, 1) < 0.3) return;
    const double overlap = uniform(0, 1) < 0.1 ? 0.0 : uniform(0.0, 0.1);
    c.past = ContactPast{overlap, uniform(0, 5), uniform(50, 100), uniform(-1, 1), uniform(-1, 1)};
    PastLanes &past = past_.here;
    past.known[k] = -1;
    past.overlap[k] = c.past->overlap;
    past.elastic_force[k] = c.past->elastic_force;
    past.tangential_stiffness[k] = c.past->tangential_stiffness;
    past.elastic_work[k] = c.past->elastic_work;
    past.spring_work[k] = c.past->spring_work;
  }
};

/** Relative to the largest, of sums of some hundred numbers. */
template <class Numbers>
void expect_near(const Numbers &a, const Numbers &b) {
  double largest = 0.0;
  for (double x : b) largest = std::max(largest, std::fabs(x));
  for (std::size_t k = 0; k < b.size(); k++) EXPECT_NEAR(a[k], b[k], 1e-13 * largest) << k;
}

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_COLLIDING_PAIR_H
#define GRAINSCOPE_COLLIDING_PAIR_H

#include "energy_ledger.h"
#include "half_step.h"
#include "make_contact.h"
#include <cmath>

namespace colliding_pair {

using Eigen::Vector3d;
using grainscope::Contact;
using grainscope::ContactMotion;
using grainscope::ContactPast;
using grainscope::ContactRolling;
using grainscope::ContactSpring;
using grainscope::ContactVelocity;
using grainscope::EnergyLedger;
using grainscope::LedgerFrame;

/** Grains 0 and 1. */
inline EnergyLedger::Members everyone() {
  static const int mask[2] = {1, 1}, ids[2] = {1, 2};
  return {mask, 1, ids};
}

/** A sphere that moves by kick, drift, kick; its velocities are those that the ledger is shown. */
struct Sphere {
  double mass, inertia;
  Vector3d x, v, omega, force = Vector3d::Zero(), torque = Vector3d::Zero();

  void kick(double dt) {
    v += 0.5 * dt / mass * force;
    omega += 0.5 * dt / inertia * torque;
  }
  EnergyLedger::Grain shown(int index) const { return {index, mass, x.data(), v.data(), force.data(), torque.data()}; }
};

/** Two spheres under a law of this test's own: an elastic force k d^(3/2), damping c d^(1/4) u_n, a tangential spring
 *  of stiffness h d^(1/2) with friction, a torque against rolling; and a constant force from outside. The ledger
 *  gets what it would get from the pair style. */
class Pair {
 public:
  static constexpr double radius = 1.0, k = 1e4, c = 30.0, h = 8e3, friction = 0.3;
  const double dt;
  Sphere spheres[2] = {{2.0, 0.8, {-1.01, 0.05, 0.0}, {0.6, 0.0, 0.1}, {0.0, 0.3, 0.9}},
                       {3.0, 1.1, {1.0, 0.0, 0.1}, {-0.4, 0.1, 0.0}, {0.2, 0.0, 0.5}}};
  EnergyLedger ledger;
  LedgerFrame frame;
  Vector3d outside = Vector3d::Zero();
  double rolling = 0.0;       // torque per difference of spins
  bool synchronized = false;  // the law takes the velocity in the middle of the step
  bool touching = false, touched = false;

  explicit Pair(double step = 1e-3) : dt(step) { ledger.set_laws(make_law(1.5, grainscope::TangentialLaw::spring)); }

  void evaluate(bool springs_move) {
    Sphere &i = spheres[0], &j = spheres[1];
    i.force = outside;
    j.force = Vector3d::Zero();
    i.torque = j.torque = Vector3d::Zero();
    ledger.begin_evaluation(2);
    const Vector3d r = i.x - j.x, n = r.normalized();
    const double d = 2.0 * radius - r.norm();
    touching = d > 0.0;
    if (!touching) {
      past_.reset();
      spring_.setZero();
      return;
    }
    touched = true;
    Contact contact;
    ContactMotion &motion = contact.motion.emplace();
    contact.i = 0;
    contact.partner = grainscope::PartnerGrain{1, false};
    contact.branch = r;
    contact.normal = n;
    contact.overlap = d;
    motion.arm = -(radius - 0.5 * d) * n;
    const Vector3d at_force = i.v - j.v + i.omega.cross(motion.arm) - j.omega.cross(motion.arm + r);
    Vector3d u = at_force;
    if (synchronized && springs_move) u = in_the_middle(r, n);
    motion.normal_velocity = u.dot(n);
    motion.tangential_velocity = u - u.dot(n) * n;
    const double normal = at_force.dot(n);
    if (synchronized) contact.at_force = ContactVelocity{normal, at_force - normal * n};
    motion.normal_stiffness = k * std::sqrt(d);
    motion.tangential_stiffness = h * std::sqrt(d);
    motion.normal_damping = -c * std::sqrt(std::sqrt(d)) * u.dot(n);
    const Vector3d before = spring_;
    Vector3d tried = spring_;
    if (springs_move) {
      tried += dt * motion.tangential_velocity;
      tried -= tried.dot(n) * n;
    }
    contact.normal_force = motion.normal_stiffness * d + motion.normal_damping;
    const double limit = friction * std::fabs(contact.normal_force) / motion.tangential_stiffness;
    contact.sliding = tried.norm() > limit;
    spring_ = contact.sliding ? Vector3d(limit / tried.norm() * tried) : tried;
    contact.spring = ContactSpring{before, spring_, tried - spring_};
    contact.tangential_force = -motion.tangential_stiffness * spring_;
    contact.force = contact.normal_force * n + contact.tangential_force;
    const Vector3d spin = i.omega - j.omega, torque = -rolling * spin;
    contact.rolling = ContactRolling{spin, torque};
    contact.past = past_;
    ledger.add({&contact, 1}, everyone(), dt, springs_move);
    past_ = ContactPast{d, motion.normal_stiffness * d, motion.tangential_stiffness,
                        -0.5 * dt * motion.normal_stiffness * d * normal,
                        0.5 * dt * motion.tangential_stiffness * spring_.dot(at_force)};
    i.force += contact.force;
    j.force -= contact.force;
    i.torque += motion.arm.cross(contact.force) + torque;
    j.torque -= (motion.arm + r).cross(contact.force) + torque;
  }

  void step(const Vector3d &unseen_kick = Vector3d::Zero()) {
    ledger.begin_start_of_step(frame);
    for (int g = 0; g < 2; g++) {
      const Sphere &s = spheres[g];
      const Vector3d momentum = s.inertia * s.omega, after = s.omega + 0.5 * dt / s.inertia * s.torque;
      ledger.start_of_step(s.shown(g), after.data(), momentum.data(), dt);
    }
    ledger.book_start(dt);
    for (Sphere &s : spheres) s.kick(dt);
    spheres[0].v += unseen_kick;
    for (Sphere &s : spheres) s.x += dt * s.v;
    evaluate(true);
    ledger.begin_end_of_step();
    for (int g = 0; g < 2; g++) {
      const Sphere &s = spheres[g];
      const Vector3d momentum = s.inertia * s.omega;
      ledger.end_of_step(s.shown(g), s.omega.data(), momentum.data(), dt);
    }
    ledger.book_step(dt);
    for (Sphere &s : spheres) s.kick(dt);
  }

  double residual() const {
    double stored = 0.0;
    for (double one : ledger.stored()) stored += one;
    return EnergyLedger::residual(ledger.totals(), stored - ledger.start_energy());
  }
  double kinetic() const {
    double sum = 0.0;
    for (const Sphere &s : spheres) sum += 0.5 * s.mass * s.v.squaredNorm() + 0.5 * s.inertia * s.omega.squaredNorm();
    return sum;
  }

 private:
  /** The velocity that the law takes; turns the spring. */
  Vector3d in_the_middle(const Vector3d &r, const Vector3d &n) {
    const Sphere &i = spheres[0], &j = spheres[1];
    grainscope::half_step::Motion<double> motion;
    Eigen::Map<Vector3d>(motion.velocity + 0) = i.v - j.v;
    Eigen::Map<Vector3d>(motion.spin_i + 0) = i.omega;
    Eigen::Map<Vector3d>(motion.spin_j + 0) = j.omega;
    Vector3d half, u;
    grainscope::half_step::of_spheres(n.data(), r.data(), radius, radius, motion, dt, half.data(), u.data());
    grainscope::half_step::turn_spring(half.data(), spring_.data());
    return u;
  }
  Vector3d spring_ = Vector3d::Zero();
  std::optional<ContactPast> past_;
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_observer.h"
#include "tangential_bound.h"
#include "atom.h"
#include "update.h"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace grainscope {

using Eigen::Map;
using Eigen::Vector3d;

ContactObserver::~ContactObserver() { remove_all(); }

void ContactObserver::add(ContactSink *sink) {
  if (std::find(sinks_.begin(), sinks_.end(), sink) != sinks_.end()) return;
  sinks_.push_back(sink);
  sink->set_source(this);
}

void ContactObserver::remove(ContactSink *sink) {
  sinks_.erase(std::remove(sinks_.begin(), sinks_.end(), sink), sinks_.end());
  listening_.erase(std::remove(listening_.begin(), listening_.end(), sink), listening_.end());
}

void ContactObserver::remove_all() {
  for (ContactSink *sink : sinks_) sink->set_source(nullptr);
  sinks_.clear();
  listening_.clear();
}

bool ContactObserver::begin(bool springs_move, bool again) {
  springs_move_ = springs_move;
  again_ = again;
  listening_.clear();
  bool images = false;
  for (ContactSink *sink : sinks_)
    if (sink->wants_contacts()) listening_.push_back(sink);
  active_ = !listening_.empty() || knows_past();
  stamp_before_ = again ? -1.0 : stamp_;
  if (!again) {
    stamp_ = lmp->update->ntimestep + (runs_ % 1023 + 1) / 1024.0;  // never 0, which is what a new neighbour has
    if (!springs_move) stamp_ = -stamp_;
  }
  if (active_) {
    box_ = BoxState(lmp);
    x_ = lmp->atom->x;
    n_local_ = lmp->atom->nlocal;
    dt_ = lmp->update->dt;
  }
  details_ = knows_past();
  for (ContactSink *sink : listening_) {
    sink->begin_contacts();
    details_ = details_ || sink->needs_details();
    images = images || sink->needs_images();
  }
  return images;
}

void ContactObserver::end_run() const {
  for (ContactSink *sink : sinks_) sink->end_run();
}

/** The spring as it was before the friction limit, in the host's own operations and order, so that a spring that was
 *  not cut compares equal to the last bit. In the first evaluation of a run the host moves no spring: a cut then means
 *  that the force was limited, and slip is what would have been cut; where it repeats an evaluation, they have been
 *  cut. */
inline void ContactObserver::judge_spring(const Sides &s, Friction &friction) const {
  double x = spring_[0], y = spring_[1], z = spring_[2];
  if (springs_move_) {
    const double dt = dt_;
    x += s.vtr1 * dt;
    y += s.vtr2 * dt;
    z += s.vtr3 * dt;
    const double along = x * s.en[0] + y * s.en[1] + z * s.en[2];
    x -= along * s.en[0];
    y -= along * s.en[1];
    z -= along * s.en[2];
  }
  friction.spring[0] = x;
  friction.spring[1] = y;
  friction.spring[2] = z;
  const double length = std::sqrt(x * x + y * y + z * z);
  friction.cut = s.kt * length > friction.limit;
  if (friction.cut && !again_) friction.slip = length - friction.limit / s.kt;
}

/** Where no spring has moved none can say that the limit is reached: the force does. */
inline void ContactObserver::judge_damping(const Sides &s, Friction &friction) const {
  const double spring[3] = {-(s.kt * spring_[0]), -(s.kt * spring_[1]), -(s.kt * spring_[2])};
  const double u[3] = {s.vtr1, s.vtr2, s.vtr3};
  friction.beyond = TangentialBound::length(s.gammat, spring, u) > friction.limit;
  if (friction.beyond && TangentialBound::get().mode() == TangentialBound::Mode::bound)
    friction.damping = TangentialBound::largest(s.gammat, spring, u, friction.limit);
}

inline ContactObserver::Friction ContactObserver::judge_friction(const Sides &s, double limit) const {
  Friction friction;
  friction.limit = limit;
  friction.damping = law_ == TangentialLaw::off ? 0.0 : s.gammat;
  if (law_ == TangentialLaw::history) {
    judge_spring(s, friction);
    if (!friction.cut && s.gammat > 0.0 && first_evaluation()) judge_damping(s, friction);
  } else if (law_ == TangentialLaw::no_history) {
    const double speed = std::sqrt(s.vtr1 * s.vtr1 + s.vtr2 * s.vtr2 + s.vtr3 * s.vtr3);
    friction.cut = limit < s.gammat * speed;
    if (friction.cut) friction.slip = speed * dt_;
  }
  return friction;
}

/** The law's tangential force by itself, where the force on i has another beside it. */
Vector3d ContactObserver::friction_force(const Sides &s, const Friction &friction, const Contact &c) const {
  const Vector3d u(s.vtr1, s.vtr2, s.vtr3), spring = Map<const Vector3d>(friction.spring);
  Vector3d force = Vector3d::Zero();
  if (law_ == TangentialLaw::other) return c.tangential_force;
  if (law_ == TangentialLaw::history)
    force = friction.cut ? Vector3d(-friction.limit * spring.normalized())
                         : Vector3d(-s.kt * spring - friction.damping * u);
  if (law_ == TangentialLaw::no_history)
    force = friction.cut ? Vector3d(-friction.limit * u.normalized()) : Vector3d(-friction.damping * u);
  return force - force.dot(c.normal) * c.normal;
}

const char *ContactObserver::past_column(int k) {
  static const char *const names[past_columns] = {"past_stamp", "past_overlap", "past_elastic_force", "past_kt", "past_elastic_work",
                                                  "past_spring_work"};
  return names[k];
}

ContactPast ContactObserver::read_past(const Sides &s) const {
  const double *at = s.contact_history + past_offset_;
  if (at[0] != stamp_before_) return ContactPast();
  return {true, at[1], at[2], at[3], at[4], at[5]};
}

void ContactObserver::write_past(const Sides &s, const Contact &c) const {
  double *at = s.contact_history + past_offset_;
  const double half = 0.5 * dt_, elastic_force = c.normal_stiffness * c.overlap;
  at[0] = stamp_;
  at[1] = c.overlap;
  at[2] = elastic_force;
  at[3] = c.tangential_stiffness;
  at[4] = -half * elastic_force * c.normal_velocity;
  at[5] = half * c.tangential_stiffness * c.spring.dot(c.tangential_velocity);
}

/** `limitForce` sets a negative total to exactly 0: the damping part is then what cancels the elastic one. */
inline double ContactObserver::normal_damping(const Sides &s) const {
  const double damping = -s.gamman * s.vn, elastic = s.kn * s.deltan;
  return elastic_ && limits_force_ && damping + elastic < 0.0 ? -elastic : damping;
}

inline void ContactObserver::add_details(const Sides &s, const Friction &friction, Contact &c) const {
  const Map<const Vector3d> xi(x_[s.i]);
  if (s.is_non_spherical) c.point = Map<const Vector3d>(s.contact_point);
  else c.point = xi - s.cri * c.normal;
  c.normal_velocity = s.vn;
  c.tangential_velocity = Vector3d(s.vtr1, s.vtr2, s.vtr3);
  c.normal_damping = normal_damping(s);
  c.normal_stiffness = s.kn;
  c.tangential_stiffness = s.kt;
  c.damping_coefficient = s.gamman;
  c.tangential_damping = friction.damping;
  c.damped = !friction.cut && friction.damping > 0.0;
  c.arm = c.point - xi;
}

/** What only the energy ledger asks for. */
void ContactObserver::add_springs(const Sides &s, const Friction &friction, const Forces &force_on_i,
                                  Contact &c) const {
  c.spring.setZero();
  c.spring_before.setZero();
  c.cut.setZero();
  if (law_ == TangentialLaw::history) {
    c.spring = Map<const Vector3d>(s.contact_history + spring_offset_);
    c.spring_before = Map<const Vector3d>(spring_);
    if (friction.cut && springs_move_) c.cut = Map<const Vector3d>(friction.spring) - c.spring;
  }
  c.rolling_torque.setZero();
  if (!rolls_) return;
  c.spin = Map<const Vector3d>(s.omega_i) - Map<const Vector3d>(s.omega_j);
  c.rolling_torque = Map<const Vector3d>(force_on_i.delta_torque) - c.arm.cross(c.force);
}

void ContactObserver::observe(const Sides &s, const Forces &force_on_i) {
  const Map<const Vector3d> xi(x_[s.i]), xj(x_[s.j]);
  const Vector3d normal(s.en[0], s.en[1], s.en[2]), force(force_on_i.delta_F[0], force_on_i.delta_F[1], force_on_i.delta_F[2]);
  const double normal_force = force.dot(normal), coefficient = friction_ ? friction_[s.itype][s.jtype] : 0.0;
  const Friction friction = judge_friction(s, coefficient * std::fabs(s.Fn));

  Contact c;
  c.i = s.i;
  c.j = s.j;
  c.ghost = s.j >= n_local_;
  c.weight = c.ghost ? 0.5 : 1.0;
  c.branch = xi - xj;
  c.normal = normal;
  c.overlap = s.deltan;
  c.force = force;
  c.normal_force = normal_force;
  c.tangential_force = force - normal_force * normal;
  c.friction = coefficient;
  c.friction_limit = friction.limit;
  c.friction_force = wet_ ? friction_force(s, friction, c) : c.tangential_force;
  c.sliding = friction.cut || friction.beyond;
  c.slip = friction.slip;
  if (details_) add_details(s, friction, c);
  ContactPast past;
  c.past = knows_past() ? &past : nullptr;
  if (knows_past()) {
    past = read_past(s);
    add_springs(s, friction, force_on_i, c);
    write_past(s, c);
  }
  for (ContactSink *sink : listening_) sink->add_contact(c);
}

}

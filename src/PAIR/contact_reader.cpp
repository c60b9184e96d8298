// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_reader.h"
#include "tangential_bound.h"
#include <Eigen/Geometry>
#include <cmath>

namespace grainscope {

using Eigen::Map;
using Eigen::Vector3d;

/** The spring before it was cut at the friction limit. The model of LIGGGHTS must be repeated for this: it shortens a
 *  spring in place and keeps neither its length nor a mark that it was cut, and friction dissipates by the length that
 *  is cut. The operations and their order are those of LIGGGHTS, so that a spring that was not cut compares equal to
 *  the last bit. In the first evaluation of a run LIGGGHTS moves no spring: a cut then means that the force was
 *  limited, and slip is what would have been cut. If the evaluation repeats another one, springs have been cut. */
inline void ContactReader::repeat_spring(const Surfaces &s, Friction &friction) const {
  double x = spring_[0], y = spring_[1], z = spring_[2];
  if (observer_.springs_move()) {
    const double dt = observer_.time_step();
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
  if (friction.cut && !observer_.repeats()) friction.slip = length - friction.limit / s.kt;
}

/** If no spring has moved, whether the limit is reached follows from the force alone. */
inline void ContactReader::compare_damping(const Surfaces &s, Friction &friction) const {
  const double spring[3] = {-(s.kt * spring_[0]), -(s.kt * spring_[1]), -(s.kt * spring_[2])};
  const double u[3] = {s.vtr1, s.vtr2, s.vtr3};
  friction.beyond = TangentialBound::length(s.gammat, spring, u) > friction.limit;
  if (friction.beyond && TangentialBound::get().mode() == TangentialBound::Mode::bound)
    friction.damping = TangentialBound::largest(s.gammat, spring, u, friction.limit);
}

inline ContactReader::Friction ContactReader::friction_of(const Surfaces &s) const {
  Friction friction;
  friction.coefficient = law_.friction_coefficient(s.itype, s.jtype);
  const double limit = friction.limit = ContactLaw::friction_limit(friction.coefficient, s.Fn);
  friction.damping = law_.tangential == TangentialLaw::none ? 0.0 : s.gammat;
  if (law_.tangential == TangentialLaw::spring) {
    repeat_spring(s, friction);
    if (!friction.cut && s.gammat > 0.0 && observer_.first_evaluation()) compare_damping(s, friction);
  } else if (law_.tangential == TangentialLaw::viscous) {
    const double speed = std::sqrt(s.vtr1 * s.vtr1 + s.vtr2 * s.vtr2 + s.vtr3 * s.vtr3);
    friction.cut = limit < s.gammat * speed;
    if (friction.cut) friction.slip = speed * observer_.time_step();
  }
  return friction;
}

/** The tangential force of the law alone, if the force on i includes another one. */
Vector3d ContactReader::friction_force(const Surfaces &s, const Friction &friction, const Contact &c) const {
  const Vector3d u(s.vtr1, s.vtr2, s.vtr3), spring = Map<const Vector3d>(friction.spring);
  Vector3d force = Vector3d::Zero();
  if (law_.tangential == TangentialLaw::unknown) return c.tangential_force;
  if (law_.tangential == TangentialLaw::spring)
    force = friction.cut ? Vector3d(-friction.limit * spring.normalized())
                         : Vector3d(-s.kt * spring - friction.damping * u);
  if (law_.tangential == TangentialLaw::viscous)
    force = friction.cut ? Vector3d(-friction.limit * u.normalized()) : Vector3d(-friction.damping * u);
  return force - force.dot(c.normal) * c.normal;
}

const char *ContactReader::past_column(int k) {
  static const char *const names[past_columns] = {"past_stamp", "past_overlap",      "past_elastic_force",
                                                  "past_kt",    "past_elastic_work", "past_spring_work"};
  return names[k];
}

/** Where the value is kept from the batch's last use: all of it is written again. */
template <class Value>
Value &kept(std::optional<Value> &value) {
  return value ? *value : value.emplace();
}

void ContactReader::read_past(const Surfaces &s, Contact &c) const {
  const double *at = s.contact_history + law_.past_column;
  if (at[0] == observer_.stamp_before()) kept(c.past) = ContactPast{at[1], at[2], at[3], at[4], at[5]};
  else c.past.reset();
}

void ContactReader::write_past(const Surfaces &s, const Contact &c) const {
  double *at = s.contact_history + law_.past_column;
  const ContactMotion &m = *c.motion;
  const ContactVelocity u = c.working_velocity();
  const double half = 0.5 * observer_.time_step(), elastic_force = m.normal_stiffness * c.overlap;
  at[0] = observer_.stamp();
  at[1] = c.overlap;
  at[2] = elastic_force;
  at[3] = m.tangential_stiffness;
  at[4] = -half * elastic_force * u.normal;
  at[5] = c.spring ? half * m.tangential_stiffness * c.spring->after.dot(u.tangential) : 0.0;
}

/** Of the surfaces, by the arms at which forces act. */
ContactVelocity ContactReader::velocity_at_force(const Surfaces &s, const Contact &c) const {
  const Vector3d &arm = c.motion->arm;
  Vector3d u = Map<const Vector3d>(s.v_i) - Map<const Vector3d>(s.v_j) + Map<const Vector3d>(s.omega_i).cross(arm);
  if (!s.is_wall) u -= Map<const Vector3d>(s.omega_j).cross(arm + c.branch);
  const double normal = u.dot(c.normal);
  return {normal, u - normal * c.normal};
}

void ContactReader::renew_past(const Surfaces &s, const Friction &friction, Contact &c) const {
  if (!law_.keeps_past()) return;
  read_past(s, c);
  if (law_.tangential == TangentialLaw::spring) read_spring(s, friction, c);
  if (law_.synchronized) kept(c.at_force) = velocity_at_force(s, c);
  write_past(s, c);
}

/** thornton_ning has no dashpot, and gives neither k_n nor gamma_n. */
static bool gives_coefficients(const ContactLaw &law) {
  return law.elastic || law.models.find("thornton_ning") == std::string::npos;
}

/** `limitForce` sets a negative total to exactly 0: the damping part is then what cancels the elastic one. */
inline double ContactReader::normal_damping(const Surfaces &s) const {
  const double damping = -s.gamman * s.vn, elastic = s.kn * s.deltan;
  return law_.elastic && law_.limits_force && damping + elastic < 0.0 ? -elastic : damping;
}

inline Vector3d ContactReader::contact_point(const Surfaces &s) const {
  const Map<const Vector3d> x(observer_.positions()[s.i]), normal(s.en);
  return s.is_non_spherical ? Vector3d(Map<const Vector3d>(s.contact_point)) : Vector3d(x - s.cri * normal);
}

inline void ContactReader::read_motion(const Surfaces &s, const Friction &friction, Contact &c) const {
  ContactMotion &m = kept(c.motion);
  const bool known = gives_coefficients(law_);
  m.point = contact_point(s);
  m.arm = m.point - Map<const Vector3d>(observer_.positions()[s.i]);
  m.normal_velocity = s.vn;
  m.tangential_velocity = Vector3d(s.vtr1, s.vtr2, s.vtr3);
  m.normal_damping = known ? normal_damping(s) : 0.0;
  m.normal_stiffness = known ? s.kn : 0.0;
  m.tangential_stiffness = s.kt;
  m.damping_coefficient = known ? s.gamman : 0.0;
  m.tangential_damping = friction.damping;
  m.damped = !friction.cut && friction.damping > 0.0;
}

inline void ContactReader::read_spring(const Surfaces &s, const Friction &friction, Contact &c) const {
  ContactSpring &spring = kept(c.spring);
  spring.after = Map<const Vector3d>(s.contact_history + law_.spring_column);
  spring.before = Map<const Vector3d>(spring_);
  if (friction.cut && observer_.springs_move()) spring.cut = Map<const Vector3d>(friction.spring) - spring.after;
  else spring.cut.setZero();
}

inline void ContactReader::read_rolling(const Surfaces &s, const Forces &force_on_i, Contact &c) const {
  ContactRolling &rolling = kept(c.rolling);
  rolling.spin = Map<const Vector3d>(s.omega_i);
  if (!s.is_wall) rolling.spin -= Map<const Vector3d>(s.omega_j);
  rolling.torque = Map<const Vector3d>(force_on_i.delta_torque) - c.motion->arm.cross(c.force);
}

inline __attribute__((always_inline)) void ContactReader::read(const Surfaces &s, const Forces &force_on_i,
                                                               const Friction &friction, Contact &c) const {
  const Vector3d normal(s.en[0], s.en[1], s.en[2]),
      force(force_on_i.delta_F[0], force_on_i.delta_F[1], force_on_i.delta_F[2]);
  const double normal_force = force.dot(normal);
  c.i = s.i;
  c.type_i = s.itype;
  c.type_j = s.jtype;
  c.law = &law_;
  c.normal = normal;
  c.overlap = s.deltan;
  c.force = force;
  c.normal_force = normal_force;
  c.tangential_force = force - normal_force * normal;
  c.friction = friction.coefficient;
  c.friction_limit = friction.limit;
  c.friction_force = law_.liquid_bridges ? friction_force(s, friction, c) : c.tangential_force;
  c.sliding = friction.cut || friction.beyond;
  c.slip = friction.slip;
  if (observer_.needs_motion()) {
    read_motion(s, friction, c);
    if (law_.rolls) read_rolling(s, force_on_i, c);
  }
}

void ContactReader::after(const Surfaces &s, const Forces &force_on_i) {
  const double *const *x = observer_.positions();
  const bool ghost = s.j >= observer_.local_grains();
  Contact &c = observer_.next();
  c.partner.emplace<PartnerGrain>(PartnerGrain{s.j, ghost});
  c.weight = ghost ? 0.5 : 1.0;
  c.branch = Map<const Vector3d>(x[s.i]) - Map<const Vector3d>(x[s.j]);
  const Friction friction = friction_of(s);
  read(s, force_on_i, friction, c);
  renew_past(s, friction, c);
}

void ContactReader::after(const PairGroup &group, const GroupGeometry &g, const GroupForces &f, int k,
                          const int types[2]) {
  const int i = group.i[k], j = group.j[k];
  const bool ghost = j >= observer_.local_grains();
  Contact &c = observer_.next(true);
  c.partner.emplace<PartnerGrain>(PartnerGrain{j, ghost});
  c.weight = ghost ? 0.5 : 1.0;
  c.branch = -Vector3d(g.d[0][k], g.d[1][k], g.d[2][k]);
  Surfaces &s = seen_;
  Forces force;
  s.i = i;
  s.j = j;
  s.itype = types[0];
  s.jtype = types[1];
  s.deltan = f.overlap[k];
  s.vn = f.normal_velocity[k];
  s.vtr1 = f.tangential_velocity[0][k];
  s.vtr2 = f.tangential_velocity[1][k];
  s.vtr3 = f.tangential_velocity[2][k];
  s.Fn = f.law_force[k];
  s.kn = f.kn[k];
  s.kt = f.kt[k];
  s.gamman = f.gamma_n[k];
  s.gammat = f.gamma_t[k];
  s.is_non_spherical = true;
  Friction friction;
  friction.coefficient = f.friction[k];
  friction.limit = f.limit[k];
  friction.damping = law_.tangential == TangentialLaw::none ? 0.0 : s.gammat;
  friction.cut = f.cut[k];
  if (friction.cut)
    friction.slip = law_.tangential == TangentialLaw::spring ? f.length[k] - f.limit[k] / s.kt
                                                             : f.length[k] * observer_.time_step();
  for (int l = 0; l < 3; l++) {
    s.en[l] = f.normal[l][k];
    s.contact_point[l] = f.point[l][k];
    force.delta_F[l] = f.force[l][k];
  }
  read(s, force, friction, c);
  c.past.reset();
  c.spring.reset();
  c.at_force.reset();
}

void ContactReader::after_wall(const Surfaces &s, const Forces &force_on_i, const PartnerWall &wall) {
  Contact &c = observer_.next();
  c.partner.emplace<PartnerWall>(PartnerWall{wall.wall, wall.triangle, Map<const Vector3d>(s.v_j)});
  c.weight = 1.0;
  const Friction friction = friction_of(s);
  read(s, force_on_i, friction, c);
  renew_past(s, friction, c);
  c.branch = c.motion ? Vector3d(-c.motion->arm)
                      : Vector3d(Map<const Vector3d>(observer_.positions()[s.i]) - contact_point(s));
}

}

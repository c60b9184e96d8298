// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_H
#define GRAINSCOPE_CONTACT_H

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <variant>

namespace grainscope {

struct ContactLaw;

/** The same contact in the previous force evaluation, kept in columns of the contact history (`pair_style gran/insitu
 *  ... ledger on`). None of it changes sign when i and j are swapped. Works are those of the half step after x_{n-1},
 *  with the velocities before it. */
struct ContactPast {
  double overlap = 0.0;
  double elastic_force = 0.0;         // k_n overlap
  double tangential_stiffness = 0.0;  // k_t
  double elastic_work = 0.0;          // taken up by the normal spring, -F_elastic u_n dt/2
  double spring_work = 0.0;           // taken up by the tangential spring, k_t s . u_t dt/2
};

/** The other grain of a contact. */
struct PartnerGrain {
  int index = -1;      // local index; may be a ghost
  bool ghost = false;  // its owner sees this contact too
};

/** A wall that a grain touches: a surface of infinite mass with a prescribed motion. */
struct PartnerWall {
  int wall = -1;      // number of the wall, from 0: a primitive wall, or one mesh of a mesh wall
  int triangle = -1;  // ID of the mesh's triangle; -1 for a primitive wall
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // at the contact point
};

/** Relative motion of the two surfaces at the contact point, and the coefficients of the contact law there. */
struct ContactMotion {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  // contact point
  // from the centre of i to the contact point; from that of j, a grain, it is arm + branch
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();
  // of i relative to its partner, at the contact point
  double normal_velocity = 0.0;  // along the normal, < 0 approaching
  Eigen::Vector3d tangential_velocity = Eigen::Vector3d::Zero();
  double normal_damping = 0.0;        // the damping part of normal_force
  double normal_stiffness = 0.0;      // secant k_n: elastic force / overlap
  double tangential_stiffness = 0.0;  // k_t
  double damping_coefficient = 0.0;   // gamma_n: damping force / normal velocity
  double tangential_damping = 0.0;    // gamma_t, acting while `damped`
  bool damped = false;                // tangential damping acts: the spring was not cut
};

/** Of i relative to its partner, at the contact point. */
struct ContactVelocity {
  double normal = 0.0;  // along the normal, < 0 approaching
  Eigen::Vector3d tangential = Eigen::Vector3d::Zero();
};

/** The tangential spring s; its force on i is -k_t s. */
struct ContactSpring {
  // of the evaluation, turned to its normal with `time_level synchronized`
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  Eigen::Vector3d after = Eigen::Vector3d::Zero();
  Eigen::Vector3d cut = Eigen::Vector3d::Zero();  // what the friction limit cut from it
};

struct ContactRolling {
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();    // angular velocity of i, less that of j where it is a grain
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  // on i, its opposite on j: the torque beyond that of the force
};

/** One contact of one force evaluation, as grain i sees it, in simulation units.
 *  Velocities are those that entered the force (x_n, v_{n-1/2}, omega_{n-1/2}); forces are those that drove the step:
 *  per grain they sum to f. All vectors are in the laboratory frame. */
struct Contact {
  int i = -1;  // local index
  // atom types of i and its partner; a wall has that of its material
  int type_i = 0, type_j = 0;
  std::variant<PartnerGrain, PartnerWall> partner;
  const ContactLaw *law = nullptr;  // the law of this contact; a wall may have another one
  // 1, or 1/2 when j is a ghost: weighted sums over ranks count each contact once
  double weight = 1.0;
  // r = x_i - x_j; at a wall x_i less the contact point
  Eigen::Vector3d branch = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit, from the partner to i
  double overlap = 0.0;                              // normal overlap, > 0
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // total force on i
  // force . normal, > 0 pushes apart; damping (and cohesion) included
  double normal_force = 0.0;
  Eigen::Vector3d tangential_force = Eigen::Vector3d::Zero();  // force on i without its normal part
  double friction = 0.0;                                       // mu_p of this pair of types
  // mu_p times the normal force of the law, which may exclude cohesion
  double friction_limit = 0.0;
  // tangential_force without the drag of a liquid bridge, which has no limit
  Eigen::Vector3d friction_force = Eigen::Vector3d::Zero();
  // the tangential spring was cut (friction limit reached) in this evaluation; in the first evaluation of a run also
  // when damping brings the force to the limit or beyond
  bool sliding = false;
  double slip = 0.0;  // length cut from the spring, >= 0

  // When a sink needs it (ContactSink::needs_motion)
  std::optional<ContactMotion> motion;
  std::optional<ContactRolling> rolling;  // of a law with a rolling model
  // Only with `ledger on`, and not when sinks take contacts side by side: GroupForces and PastLanes hold it then
  std::optional<ContactPast> past;      // of contacts that touched in the previous evaluation
  std::optional<ContactSpring> spring;  // of a law that has one
  // With `time_level synchronized`: the velocity at x_n, where forces act. The law takes that of the middle of the step.
  std::optional<ContactVelocity> at_force;

  /** The velocity that forces work with. */
  ContactVelocity working_velocity() const {
    return at_force ? *at_force : ContactVelocity{motion->normal_velocity, motion->tangential_velocity};
  }
  bool with_wall() const { return std::holds_alternative<PartnerWall>(partner); }
  /** Of a contact with a wall. */
  const PartnerWall &wall() const { return std::get<PartnerWall>(partner); }
  /** Local index of the other grain, of a contact between grains. */
  int j() const { return std::get<PartnerGrain>(partner).index; }
  /** The other grain is a ghost: its owner sees this contact too. */
  bool ghost() const { return !with_wall() && std::get<PartnerGrain>(partner).ghost; }
  /** The partner is a grain of this rank, to which this contact belongs too. */
  bool with_own_grain() const { return !with_wall() && !std::get<PartnerGrain>(partner).ghost; }
};

/** Contacts one after the other in memory. */
class ContactSpan {
 public:
  ContactSpan(const Contact *first, std::size_t count) : first_(first), count_(count) {}
  const Contact *begin() const { return first_; }
  const Contact *end() const { return first_ + count_; }
  std::size_t size() const { return count_; }

 private:
  const Contact *first_;
  std::size_t count_;
};

}

#endif

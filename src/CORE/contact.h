// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_H
#define GRAINSCOPE_CONTACT_H

#include <Eigen/Core>

namespace grainscope {

/** What a contact remembers of the force evaluation before, in columns of the contact history (`pair_style gran/insitu ... ledger on`).
 *  Nothing of it changes its sign when i and j are swapped. Works are those of the half step after x_{n-1}, with the velocities before it. */
struct ContactPast {
  bool touched = false;                  // in the evaluation before; else all below is 0
  double overlap = 0.0;
  double elastic_force = 0.0;            // k_n overlap
  double tangential_stiffness = 0.0;     // k_t
  double elastic_work = 0.0;             // taken up by the normal spring, -F_elastic u_n dt/2
  double spring_work = 0.0;              // taken up by the tangential spring, k_t s . u_t dt/2
};

/** One grain-grain contact of one force evaluation, as grain i sees it, in simulation units.
 *  Velocities are those that entered the force (x_n, v_{n-1/2}, omega_{n-1/2}); forces are those that drove the step:
 *  per grain they sum to f. All vectors are in the laboratory frame. The details are filled in only when a sink needs them. */
struct Contact {
  int i, j;                              // local indices; j may be a ghost
  bool ghost;                            // j is a ghost: its owner sees this contact too
  double weight;                         // 1, or 1/2 when j is a ghost: weighted sums over ranks count each contact once
  Eigen::Vector3d branch;                // r = x_i - x_j
  Eigen::Vector3d normal;                // unit, from j to i
  double overlap;                        // normal overlap, > 0
  Eigen::Vector3d force;                 // total force on i
  double normal_force;                   // force . normal, > 0 pushes apart; damping (and cohesion) included
  Eigen::Vector3d tangential_force;      // force on i less its normal part
  double friction;                       // mu_p of this pair of types
  double friction_limit;                 // mu_p times the normal force of the law: cohesion may be no part of it
  Eigen::Vector3d friction_force;        // tangential_force less the drag of a liquid bridge, which no friction limits
  bool sliding;                          // the tangential spring was cut (friction limit reached) in this evaluation;
                                         // in the first of a run also: damping takes the force to the limit or beyond
  double slip;                           // length cut from the spring, >= 0

  // Details
  Eigen::Vector3d point;                 // contact point
  double normal_velocity;                // (v_i - v_j at the contact point) . normal, < 0 approaching
  Eigen::Vector3d tangential_velocity;   // of i relative to j at the contact point
  double normal_damping;                 // the damping part of normal_force
  double normal_stiffness;               // secant k_n: elastic force / overlap
  double tangential_stiffness;           // k_t
  double damping_coefficient;            // gamma_n: damping force / normal velocity
  double tangential_damping;             // gamma_t, acting while `damped`
  bool damped;                           // tangential damping acts: the spring was not cut
  Eigen::Vector3d arm;                   // from the centre of i to the contact point; from that of j it is arm + branch
  Eigen::Vector3d spring;                // tangential spring s after the update (0 without one): its force on i is -k_t s
  Eigen::Vector3d spring_before;         // the same before it
  Eigen::Vector3d cut;                   // what the friction limit cut from it
  Eigen::Vector3d spin;                  // angular velocity of i less that of j
  Eigen::Vector3d rolling_torque;        // on i, its opposite on j: what the torque has beside the force's
  const ContactPast *past;               // null unless the history has it
};

}

#endif

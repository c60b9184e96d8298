// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_LAW_H
#define GRAINSCOPE_CONTACT_LAW_H

#include "contact.h"
#include <cmath>
#include <string>

namespace grainscope {

/** `tangential` off, no_history, history; or a model whose friction is not known here. */
enum class TangentialLaw { none, viscous, spring, unknown };

/** What is known of the contact models of a pair style: the one place that says what a measure may rely on. Made when a
 *  run is set up. */
struct ContactLaw {
  std::string models;  // the words of the command, for messages
  TangentialLaw tangential = TangentialLaw::unknown;
  // the normal force is a spring and a dashpot: k_n and gamma_n are what the model says
  bool elastic = false;
  double exponent = 1.5;      // of the elastic normal force in the overlap: 3/2 Hertz, 1 Hooke
  bool limits_force = false;  // a normal force that would be negative is set to 0
  bool cohesive = true;
  bool liquid_bridges = false;  // cohesion has a tangential force of its own, without a friction limit
  bool rolls = false;           // there is a rolling friction
  bool known_rolling = false;   // and it is a torque between the two grains, on both alike
  bool known_surface = false;
  const double *const *friction = nullptr;  // mu_p of each pair of types; null without friction
  int spring_column = -1;                   // first of three in the contact history, of TangentialLaw::spring
  int past_column = -1;                     // first of those that hold a ContactPast, or -1
  bool synchronized = false;                // `time_level synchronized`

  bool keeps_past() const { return past_column >= 0; }
  /** Contacts resist tangential motion elastically; assumed of unknown models too. */
  bool sticks() const { return tangential == TangentialLaw::spring || tangential == TangentialLaw::unknown; }
  /** dF_n/d(overlap) of the elastic part. */
  double tangent_stiffness(const ContactMotion &m) const { return exponent * m.normal_stiffness; }
  double friction_coefficient(int type_i, int type_j) const { return friction ? friction[type_i][type_j] : 0.0; }
  /** The limit to which the law cuts the tangential force. `normal_force` is that of the law, which may exclude
   *  cohesion. */
  static double friction_limit(double coefficient, double normal_force) {
    return coefficient * std::fabs(normal_force);
  }

  // Why a measure cannot be right with this law, as the text after "compute x: " in a message; empty if it can.
  /** Power lost to damping and friction. */
  std::string why_no_losses() const;
  /** Energy stored, lost and supplied: the ledger. */
  std::string why_no_energy() const;
  /** Stiffness of the contact network. */
  bool knows_stiffness() const { return elastic; }
  bool knows_sliding() const { return tangential != TangentialLaw::unknown; }

  static const char *elastic_models() { return "hertz, hooke, hertz/stiffness and hooke/stiffness"; }
};

}

#endif

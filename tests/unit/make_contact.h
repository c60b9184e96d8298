// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_MAKE_CONTACT_H
#define GRAINSCOPE_MAKE_CONTACT_H

#include "contact_law.h"

/** Grain 0 touches grain 1 along x, two apart: a normal force of 10, of which 4 is damping, and friction of 3 along
 *  y. */
inline grainscope::Contact make_contact(double weight = 1.0) {
  grainscope::Contact c;
  grainscope::ContactMotion &motion = c.motion.emplace();
  c.i = 0;
  c.partner = grainscope::PartnerGrain{1, weight < 1.0};
  c.weight = weight;
  c.branch = Eigen::Vector3d(2.0, 0.0, 0.0);
  motion.point = Eigen::Vector3d(-1.0, 0.0, 0.0);
  c.normal = Eigen::Vector3d(1.0, 0.0, 0.0);
  c.overlap = 0.01;
  c.normal_force = 10.0;
  motion.normal_damping = 4.0;
  motion.normal_velocity = -0.5;
  c.tangential_force = Eigen::Vector3d(0.0, 3.0, 0.0);
  c.force = Eigen::Vector3d(10.0, 3.0, 0.0);
  motion.tangential_velocity = Eigen::Vector3d(0.0, -2.0, 0.0);
  c.friction = 0.3;
  c.friction_limit = 3.0;
  c.friction_force = c.tangential_force;
  c.sliding = true;
  c.slip = 0.002;
  motion.normal_stiffness = 600.0;
  motion.tangential_stiffness = 500.0;
  motion.damping_coefficient = 8.0;
  motion.tangential_damping = 5.0;
  return c;
}

/** The contact by another law, which must outlive it. */
inline grainscope::Contact by(grainscope::Contact contact, const grainscope::ContactLaw &law) {
  contact.law = &law;
  return contact;
}

inline grainscope::ContactLaw make_law(double exponent, grainscope::TangentialLaw tangential, bool rolls = false) {
  grainscope::ContactLaw law;
  law.exponent = exponent;
  law.tangential = tangential;
  law.rolls = rolls;
  return law;
}

#endif

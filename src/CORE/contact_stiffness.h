// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_STIFFNESS_H
#define GRAINSCOPE_CONTACT_STIFFNESS_H

#include "contact_law.h"

namespace grainscope {

/** Response of the force of a contact to a small relative motion of its bodies: k_n and gamma_n along the normal, k_t
 *  and gamma_t across it. k_n is the tangent stiffness. k_t is 0 for laws that do not stick, gamma_t is 0 where the
 *  tangential force is cut. */
struct ContactStiffness {
  double k_n, k_t, gamma_n, gamma_t;

  explicit ContactStiffness(const Contact &c) {
    const ContactLaw &law = *c.law;
    const ContactMotion &m = *c.motion;
    k_n = law.tangent_stiffness(m);
    k_t = law.sticks() ? m.tangential_stiffness : 0.0;
    gamma_n = m.damping_coefficient;
    gamma_t = m.damped ? m.tangential_damping : 0.0;
  }
  /** Of a pair of directions, `along` the normal and `across` it: a . (n n) b and a . (1 - n n) b. */
  double stiffness(double along, double across) const { return k_n * along + k_t * across; }
  double damping(double along, double across) const { return gamma_n * along + gamma_t * across; }
};

}

#endif

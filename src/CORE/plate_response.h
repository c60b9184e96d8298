// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PLATE_RESPONSE_H
#define GRAINSCOPE_PLATE_RESPONSE_H

#include "contact_law.h"

namespace grainscope {

/** What the grains say to a plate that moves along an axis a, over its contacts in one evaluation, or over its area and
 *  summed over several. Were the grains held, a plate that moves by dx at the velocity v would change its force by
 *  (stiffness) dx + (damping) v:
 *  stiffness = sum k n_a^2 + k_t (1 - n_a^2), damping = sum gamma_n n_a^2 + gamma_t (1 - n_a^2), k the tangent normal
 *  stiffness, gamma_t that of contacts whose tangential force is not cut. */
struct PlateResponse {
  double force = 0.0;  // of the grains on the plate, along the axis
  double stiffness = 0.0;
  double damping = 0.0;

  void add(const Contact &c, int axis) {
    const ContactLaw &law = *c.law;
    const ContactMotion &m = *c.motion;
    const double n2 = c.normal[axis] * c.normal[axis];
    force -= c.weight * c.force[axis];
    stiffness +=
        c.weight * (law.tangent_stiffness(m) * n2 + (law.sticks() ? m.tangential_stiffness * (1.0 - n2) : 0.0));
    damping += c.weight * (m.damping_coefficient * n2 + (m.damped ? m.tangential_damping * (1.0 - n2) : 0.0));
  }
  void add(const PlateResponse &other, double factor) {
    force += factor * other.force;
    stiffness += factor * other.stiffness;
    damping += factor * other.damping;
  }
};

}

#endif

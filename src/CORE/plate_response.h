// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PLATE_RESPONSE_H
#define GRAINSCOPE_PLATE_RESPONSE_H

#include "contact_stiffness.h"
#include <cmath>

namespace grainscope {

/** Force, stiffness and damping of the grains on a plate that moves along an axis a: of its contacts in one evaluation,
 *  or per area and summed over several evaluations. If the grains were held, a plate that moves by dx at the velocity v
 *  would change its force by (stiffness) dx + (damping) v:
 *      stiffness = sum k n_a^2 + k_t (1 - n_a^2), damping = sum gamma_n n_a^2 + gamma_t (1 - n_a^2), by
 *        ContactStiffness. */
struct PlateResponse {
  double force = 0.0;  // of the grains on the plate, along the axis
  double stiffness = 0.0;
  double damping = 0.0;

  void add(const Contact &c, int axis) {
    const ContactStiffness contact(c);
    const double along = c.normal[axis] * c.normal[axis], across = 1.0 - along;
    force -= c.weight * c.force[axis];
    stiffness += c.weight * contact.stiffness(along, across);
    damping += c.weight * contact.damping(along, across);
  }
  void add(const PlateResponse &other, double factor) {
    force += factor * other.force;
    stiffness += factor * other.stiffness;
    damping += factor * other.damping;
  }
};

/** The speed at which the inertia of the grains that the plate hits gives a hundredth of the target pressure; infinite
 *  without grains (density 0). */
inline double soft_rate(double target, double density) {
  return density > 0.0 ? 0.1 * std::sqrt(target / density) : HUGE_VAL;
}

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_MEASURES_H
#define GRAINSCOPE_CONTACT_MEASURES_H

#include "contact.h"
#include <algorithm>

namespace grainscope {

/** |F_t| over the limit to which the friction law cuts it, at most 1 where it was cut; 0 for frictionless contacts. */
inline double mobilisation(const Contact &c) {
  if (!(c.friction_limit > 0.0)) return 0.0;
  const double ratio = c.friction_force.norm() / c.friction_limit;
  return c.sliding && !c.motion->damped ? std::min(ratio, 1.0) : ratio;
}

/** Power lost to normal damping at this instant, -F_damping u_n. Bilotto et al. 2025, Eq. (4). */
inline double damping_loss(const Contact &c) { return -c.motion->normal_damping * c.motion->normal_velocity; }

/** Power lost to friction at this instant, -F_t . u_t of a contact that was cut. Bilotto et al. 2025, Eq. (4). */
inline double friction_loss(const Contact &c) {
  return c.sliding && !c.motion->damped ? -c.friction_force.dot(c.motion->tangential_velocity) : 0.0;
}

/** Power lost to tangential damping at this instant, of a contact that was not cut. */
inline double tangential_damping_loss(const Contact &c) {
  return c.motion->damped ? c.motion->tangential_damping * c.motion->tangential_velocity.squaredNorm() : 0.0;
}

/** F_n |u_t| of a contact that slides: what wears a surface by Archard's law. */
inline double archard_rate(const Contact &c) {
  return c.sliding && !c.motion->damped ? std::max(c.normal_force, 0.0) * c.motion->tangential_velocity.norm() : 0.0;
}

}

#endif

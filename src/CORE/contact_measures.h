// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_MEASURES_H
#define GRAINSCOPE_CONTACT_MEASURES_H

#include "contact.h"
#include <cmath>

namespace grainscope {

/** |F_t| / (mu_p |F_n|); 0 for frictionless contacts. */
inline double mobilisation(const Contact &c) {
  const double limit = c.friction * std::fabs(c.normal_force);
  return limit > 0.0 ? c.tangential_force.norm() / limit : 0.0;
}

/** Power lost to normal damping at this instant, -F_damping u_n. Bilotto et al. 2025, Eq. (4). */
inline double damping_loss(const Contact &c) { return -c.normal_damping * c.normal_velocity; }

/** Power lost to friction at this instant, -F_t . u_t of a sliding contact. Bilotto et al. 2025, Eq. (4). */
inline double friction_loss(const Contact &c) { return c.sliding ? -c.tangential_force.dot(c.tangential_velocity) : 0.0; }

}

#endif

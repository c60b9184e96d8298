// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_LOSS_SUMS_H
#define GRAINSCOPE_LOSS_SUMS_H

#include "contact_measures.h"
#include <array>

namespace grainscope {

/** Sums over contacts of what is lost, Bilotto et al. 2025, Eq. (4). */
struct LossSums {
  enum class Of {
    powers,   // at this instant
    slip,     // what friction takes, |F_t| slip, an energy; damping is not summed
    contacts  // nothing but their number
  } of = Of::powers;
  enum { normal_damping, friction, tangential_damping, contacts, sliding };
  std::array<double, 5> sums{};

  void reset() { sums.fill(0.0); }
  void add(const Contact &c) {
    sums[contacts] += c.weight;
    if (c.sliding) sums[sliding] += c.weight;
    if (of == Of::slip && c.sliding) sums[friction] += c.weight * c.friction_force.norm() * c.slip;
    if (of != Of::powers) return;
    sums[normal_damping] += c.weight * damping_loss(c);
    sums[friction] += c.weight * friction_loss(c);
    sums[tangential_damping] += c.weight * tangential_damping_loss(c);
  }
  std::array<double, 5> &numbers() { return sums; }
};

}

#endif

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
  enum { normal_damping, friction, tangential_damping, contacts, sliding, WIDTH };
  std::array<double, 2 * WIDTH> all{};  // of contacts between grains, then of those with walls

  void reset() { all.fill(0.0); }
  void add(const Contact &c) {
    double *const sums = c.with_wall() ? of_walls() : of_grains();
    sums[contacts] += c.weight;
    if (c.sliding) sums[sliding] += c.weight;
    if (of == Of::slip && c.sliding) sums[friction] += c.weight * c.friction_force.norm() * c.slip;
    if (of != Of::powers) return;
    sums[normal_damping] += c.weight * damping_loss(c);
    sums[friction] += c.weight * friction_loss(c);
    sums[tangential_damping] += c.weight * tangential_damping_loss(c);
  }
  double *of_grains() { return all.data(); }
  double *of_walls() { return all.data() + WIDTH; }
  std::array<double, 2 * WIDTH> &numbers() { return all; }
};

}

#endif

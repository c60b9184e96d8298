// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_VELOCITY_COMPONENT_H
#define GRAINSCOPE_VELOCITY_COMPONENT_H

#include "arguments.h"
#include "fluctuations.h"
#include "two_dimensions.h"

namespace grainscope {

/** One component of a grain's fluctuation: dv_x, dv_y, dv_z or dw_x, dw_y, dw_z. */
struct VelocityComponent {
  bool spin = false;
  int axis = 1;

  /** Reads what follows the keyword 'component': vx, vy, vz, wx, wy or wz; with `dimension 2` vx, vy or wz. */
  void read(Arguments &arguments) {
    const std::string name = arguments.choice("component", {"vx", "vy", "vz", "wx", "wy", "wz"});
    spin = name[0] == 'w';
    axis = name[1] - 'x';
    const bool in_plane = spin == (axis == 2);
    if (arguments.host()->domain->dimension == 2 && !in_plane)
      arguments.fail("component", "vx, vy or wz with 'dimension 2'", name);
  }
  double of(const Fluctuations &motion, const Fluctuations::Grain &grain) const {
    return (spin ? motion.spin(grain) : motion.velocity(grain))[axis];
  }
};

}

#endif

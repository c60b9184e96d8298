// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_LANE_VECTORS_H
#define GRAINSCOPE_LANE_VECTORS_H

#include "lanes.h"
#include <Eigen/Core>

/** A vector, or a number, in lanes. */
namespace grainscope {

GRAINSCOPE_INLINE void add_to(double *memory, const Lanes &lanes) { store(load(memory) + lanes, memory); }
GRAINSCOPE_INLINE void take_from(double *memory, const Lanes &lanes) { store(load(memory) - lanes, memory); }
/** The fourth repeats the third, and is read by nobody. (A zero there would be cheap too, but by an instruction that
 *  valgrind does not know.) */
GRAINSCOPE_INLINE Lanes lanes_of(double x, double y, double z) { return Lanes{x, y, z, z}; }
GRAINSCOPE_INLINE Lanes lanes_of(const Eigen::Vector3d &v) { return lanes_of(v[0], v[1], v[2]); }
GRAINSCOPE_INLINE Lanes lanes_of(double x) { return Lanes{x, x, x, x}; }
/** Torque of a force. */
GRAINSCOPE_INLINE Lanes torque_of(const Eigen::Vector3d &arm, const Eigen::Vector3d &f) {
  return lanes_of(arm[1] * f[2] - arm[2] * f[1], arm[2] * f[0] - arm[0] * f[2], arm[0] * f[1] - arm[1] * f[0]);
}

}

#endif

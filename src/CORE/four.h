// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FOUR_H
#define GRAINSCOPE_FOUR_H

#include "lanes.h"
#include <Eigen/Core>
#include <cstring>

namespace grainscope {

/** Four numbers side by side, wherever the allocator put them: not through a reference, which clang takes for
 *  aligned. */
typedef double Four __attribute__((vector_size(32)));
typedef long long FourMask __attribute__((vector_size(32)));
template <>
struct MaskOf<Four> {
  using type = FourMask;
};
GRAINSCOPE_INLINE Four four_at(const double *memory) {
  Four four;
  std::memcpy(&four, memory, sizeof four);
  return four;
}
GRAINSCOPE_INLINE void put(const Four &four, double *memory) { std::memcpy(memory, &four, sizeof four); }
GRAINSCOPE_INLINE void add_to(double *memory, const Four &four) { put(four_at(memory) + four, memory); }
GRAINSCOPE_INLINE void take_from(double *memory, const Four &four) { put(four_at(memory) - four, memory); }
/** The fourth repeats the third, and is read by nobody. (A zero there would be cheap too, but by an instruction that
 *  valgrind does not know.) */
GRAINSCOPE_INLINE Four four_of(double x, double y, double z) { return Four{x, y, z, z}; }
GRAINSCOPE_INLINE Four four_of(const Eigen::Vector3d &v) { return four_of(v[0], v[1], v[2]); }
GRAINSCOPE_INLINE Four four_times(double x) { return Four{x, x, x, x}; }
/** Torque of a force. */
GRAINSCOPE_INLINE Four torque_of(const Eigen::Vector3d &arm, const Eigen::Vector3d &f) {
  return four_of(arm[1] * f[2] - arm[2] * f[1], arm[2] * f[0] - arm[0] * f[2], arm[0] * f[1] - arm[1] * f[0]);
}

GRAINSCOPE_INLINE Four root(Four x) { return Four{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])}; }
GRAINSCOPE_INLINE double absolute(double x) { return std::fabs(x); }
GRAINSCOPE_INLINE Four absolute(Four x) { return (Four)((FourMask)x & 0x7fffffffffffffffLL); }
GRAINSCOPE_INLINE bool all(bool condition) { return condition; }
GRAINSCOPE_INLINE bool all(FourMask condition) {
  return (condition[0] & condition[1] & condition[2] & condition[3]) != 0;
}

}

#endif

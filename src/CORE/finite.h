// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FINITE_H
#define GRAINSCOPE_FINITE_H

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace grainscope {

/** Whether none of n numbers is NaN or infinite: such have all bits of the exponent set, and adding one more carries
 *  into the sign's place. Integers, so that the loop runs on several numbers at once. */
inline bool all_finite(const double *values, std::size_t n) {
  std::uint64_t carried = 0;
  for (std::size_t k = 0; k < n; k++) {
    std::uint64_t bits;
    std::memcpy(&bits, values + k, sizeof bits);
    carried |= (bits & 0x7fffffffffffffffu) + 0x0010000000000000u;
  }
  return carried < 0x8000000000000000u;
}

}

#endif

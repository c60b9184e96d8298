// SPDX-License-Identifier: GPL-2.0-or-later
#include "finite.h"
#include "lanes.h"
#include <cstdint>
#include <cstring>

namespace grainscope {

namespace {

constexpr std::uint64_t SIGN = 0x8000000000000000u, LOWEST_OF_EXPONENT = 0x0010000000000000u;
typedef std::uint64_t Four __attribute__((vector_size(32)));
constexpr int FOUR = 4, BLOCK = 8 * FOUR;

/** Numbers that are not finite have all bits of the exponent set: adding one more carries into the sign's place. */
template <class Whole>
GRAINSCOPE_INLINE Whole carried(const double *values) {
  Whole bits;
  std::memcpy(&bits, values, sizeof bits);
  return (bits & ~SIGN) + LOWEST_OF_EXPONENT;
}

}

GRAINSCOPE_CLONES bool all_finite(const double *values, std::size_t n) {
  std::size_t k = 0;
  Four four{};
  for (; k + BLOCK <= n; k += BLOCK)
    for (int b = 0; b < BLOCK; b += FOUR) four |= carried<Four>(values + k + b);
  std::uint64_t all = four[0] | four[1] | four[2] | four[3];
  for (; k < n; k++) all |= carried<std::uint64_t>(values + k);
  return all < SIGN;
}

}

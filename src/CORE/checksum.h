// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CHECKSUM_H
#define GRAINSCOPE_CHECKSUM_H

#include <cstddef>
#include <cstdint>
#include <string>

namespace grainscope {

/** CRC-64/XZ of n bytes (ECMA-182, reflected; 0x995dc9bbdf1939fa of "123456789"): the same in every version of every
 *  library, so that restart files may hold it. */
std::uint64_t checksum(const void *bytes, std::size_t n);

/** Its upper 53 bits, as a whole number that a double holds exactly. */
inline double checksum_as_double(const void *bytes, std::size_t n) {
  return static_cast<double>(checksum(bytes, n) >> 11);
}
inline double checksum_as_double(const std::string &text) { return checksum_as_double(text.data(), text.size()); }

}

#endif

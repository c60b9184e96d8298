// SPDX-License-Identifier: GPL-2.0-or-later
#include "checksum.h"
#include <boost/crc.hpp>

namespace grainscope {

std::uint64_t checksum(const void *bytes, std::size_t n) {
  constexpr std::uint64_t polynomial = 0x42f0e1eba9ea3693u, all_ones = ~std::uint64_t(0);
  boost::crc_optimal<64, polynomial, all_ones, all_ones, true, true> crc;
  crc.process_bytes(bytes, n);
  return crc.checksum();
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "checksum.h"
#include <gtest/gtest.h>
#include <set>
#include <string>

using grainscope::checksum;
using grainscope::checksum_as_double;

/** The check value of the catalogue of CRCs, and of nothing. */
TEST(checksum, is_crc_64_xz) {
  EXPECT_EQ(checksum("123456789", 9), 0x995dc9bbdf1939fau);
  EXPECT_EQ(checksum("", 0), 0u);
}

TEST(checksum, as_a_double_keeps_53_bits_exactly) {
  EXPECT_EQ(checksum_as_double(std::string("123456789")), 5396099057312551.0);
}

/** Any byte of a grain's numbers may change by itself: no such change may go unnoticed, though 11 bits are dropped. */
TEST(checksum, one_changed_byte_changes_it) {
  std::string numbers(17 * sizeof(double), '\x3f');
  std::set<double> seen = {checksum_as_double(numbers)};
  for (std::size_t k = 0; k < numbers.size(); k++)
    for (int change = 1; change < 256; change++) {
      std::string other = numbers;
      other[k] = static_cast<char>(other[k] ^ change);
      EXPECT_TRUE(seen.insert(checksum_as_double(other)).second) << "byte " << k << " changed by " << change;
    }
}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "bin_index.h"
#include <gtest/gtest.h>
#include <cmath>
#include <limits>

using grainscope::bin_index;
using grainscope::nearest_bin_index;
using grainscope::whole_count;

namespace {

const double nan_value = std::nan(""), infinite = std::numeric_limits<double>::infinity();

}

TEST(bin_index, is_the_floor_of_what_lies_inside) {
  for (int k = 0; k < 7; k++)
    for (double within : {0.0, 1e-300, 0.25, 0.999}) {
      EXPECT_EQ(bin_index(k + within, 7), k);
      EXPECT_EQ(nearest_bin_index(k + within, 7), k);
    }
  EXPECT_EQ(bin_index(-0.0, 7), 0);
  EXPECT_EQ(bin_index(std::nextafter(7.0, 0.0), 7), 6);
}

TEST(bin_index, refuses_what_lies_outside) {
  for (double at : {7.0, 7.5, 1e300, infinite, -1e-300, -1.0, -1e300, -infinite, nan_value, -nan_value}) {
    EXPECT_EQ(bin_index(at, 7), -1) << at;
    EXPECT_EQ(bin_index(at, 7, 7), 7) << at;
  }
}

TEST(bin_index, of_the_nearest_bin_beyond_the_ends) {
  for (double at : {7.0, 7.5, 1e300, infinite}) EXPECT_EQ(nearest_bin_index(at, 7), 6) << at;
  for (double at : {-1e-300, -1.0, -1e300, -infinite}) EXPECT_EQ(nearest_bin_index(at, 7), 0) << at;
}

TEST(bin_index, of_no_number_is_none) {
  for (double at : {nan_value, -nan_value})
    for (int bins : {1, 2, 7, std::numeric_limits<int>::max()}) {
      EXPECT_EQ(nearest_bin_index(at, bins), -1);
      EXPECT_EQ(bin_index(at, bins), -1);
    }
}

TEST(bin_index, goes_to_the_largest_number_of_bins) {
  const int most = std::numeric_limits<int>::max();
  EXPECT_EQ(bin_index(most - 1.0, most), most - 1);
  EXPECT_EQ(bin_index(most, most), -1);
  EXPECT_EQ(nearest_bin_index(1e10, most), most - 1);
}

TEST(bin_index, counts_are_whole_and_bounded) {
  EXPECT_EQ(whole_count(0.0, 10.0), 0);
  EXPECT_EQ(whole_count(10.0, 10.0), 10);
  EXPECT_EQ(whole_count(9007199254740992.0, 9007199254740992.0), 9007199254740992LL);
  for (double value : {-1.0, 0.5, 10.5, 11.0, 1e300, infinite, -infinite, nan_value})
    EXPECT_EQ(whole_count(value, 10.0), -1) << value;
}

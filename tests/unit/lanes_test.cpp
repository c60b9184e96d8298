// SPDX-License-Identifier: GPL-2.0-or-later
#include "lanes.h"
#include <gtest/gtest.h>
#include <cmath>
#include <limits>

using namespace grainscope;

namespace {

const double NOTHING = std::numeric_limits<double>::quiet_NaN();

LaneMask mask_of(int bits) {
  LaneMask mask;
  for (int k = 0; k < LANES; k++) mask[k] = bits >> k & 1 ? -1 : 0;
  return mask;
}

}

TEST(lanes, transpose_makes_rows_of_columns_and_back) {
  Lanes rows[LANES], columns[LANES], again[LANES];
  for (int i = 0; i < LANES; i++)
    for (int k = 0; k < LANES; k++) rows[i][k] = 10 * i + k;
  transpose(rows, columns);
  transpose(columns, again);
  for (int i = 0; i < LANES; i++)
    for (int k = 0; k < LANES; k++) {
      EXPECT_EQ(columns[k][i], 10 * i + k);
      EXPECT_EQ(again[i][k], rows[i][k]);
    }
}

TEST(lanes, rows_are_loaded_from_wherever_they_begin) {
  double numbers[40];
  for (int k = 0; k < 40; k++) numbers[k] = k;
  const int begin[LANES] = {30, 1, 13, 1};
  Lanes columns[LANES];
  load_rows([&](int k) { return numbers + begin[k]; }, columns);
  for (int k = 0; k < LANES; k++)
    for (int i = 0; i < LANES; i++) EXPECT_EQ(columns[i][k], begin[k] + i);
}

TEST(lanes, are_stored_as_they_were_loaded_and_nowhere_else) {
  double from[7], to[7] = {};
  for (int k = 0; k < 7; k++) from[k] = 1.0 + k;
  store(load(from + 1), to + 2);
  const double expected[7] = {0, 0, 2, 3, 4, 5, 0};
  for (int k = 0; k < 7; k++) EXPECT_EQ(to[k], expected[k]);
}

TEST(lanes, each_is_picked_by_its_own_condition) {
  const Lanes yes = {1, 2, 3, 4}, no = {-1, NOTHING, -3, -4};
  for (int bits = 0; bits < 16; bits++) {
    const LaneMask mask = mask_of(bits);
    const Lanes picked = pick(mask, yes, no);
    const LaneMask picked_mask = pick(mask, mask_of(5), mask_of(6));
    for (int k = 0; k < LANES; k++) {
      const bool condition = bits >> k & 1;
      if (condition) EXPECT_EQ(picked[k], yes[k]);
      else EXPECT_TRUE(picked[k] == no[k] || std::isnan(no[k]));
      EXPECT_EQ(picked_mask[k], mask_of(condition ? 5 : 6)[k]);
    }
    EXPECT_EQ(any(mask), bits != 0);
  }
  EXPECT_EQ(pick(true, 1.0, 2.0), 1.0);
  EXPECT_EQ(pick(false, 1.0, 2.0), 2.0);
  EXPECT_TRUE(any(true));
  EXPECT_FALSE(any(false));
}

TEST(lanes, roots_are_those_of_single_numbers) {
  const double numbers[] = {0.0, 2.0, 1e-310, 1e300, HUGE_VAL, 3.0, 1.0, 0.1};
  for (int first = 0; first < 8; first += LANES) {
    const Lanes roots = root(load(numbers + first));
    for (int k = 0; k < LANES; k++) EXPECT_EQ(roots[k], std::sqrt(numbers[first + k]));
  }
  const Lanes none = root(Lanes{-1.0, NOTHING, 4.0, -0.0});
  EXPECT_TRUE(std::isnan(none[0]) && std::isnan(none[1]));
  EXPECT_EQ(none[2], 2.0);
  EXPECT_TRUE(std::signbit(none[3]));
}

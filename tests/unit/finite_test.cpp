// SPDX-License-Identifier: GPL-2.0-or-later
#include "finite.h"
#include <gtest/gtest.h>
#include <limits>
#include <vector>

using Limits = std::numeric_limits<double>;

TEST(finite, sees_each_number) {
  for (std::size_t n = 0; n < 100; n++) {
    std::vector<double> values(n, 1.0);
    EXPECT_TRUE(grainscope::all_finite(values.data(), n)) << n;
    for (double &value : values)
      for (double broken : {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN(), -Limits::quiet_NaN(),
                            Limits::signaling_NaN()}) {
        value = broken;
        EXPECT_FALSE(grainscope::all_finite(values.data(), n)) << n << " " << &value - values.data();
        value = 1.0;
      }
  }
}

TEST(finite, every_other_number_is) {
  for (double extreme : {0.0, -0.0, Limits::max(), Limits::lowest(), Limits::min(), Limits::denorm_min()}) {
    const std::vector<double> values(70, extreme);
    EXPECT_TRUE(grainscope::all_finite(values.data(), values.size())) << extreme;
  }
}

TEST(finite, looks_no_farther) {
  std::vector<double> values(70, 1.0);
  values.back() = values.front() = Limits::quiet_NaN();
  EXPECT_TRUE(grainscope::all_finite(&values[1], 68));
}

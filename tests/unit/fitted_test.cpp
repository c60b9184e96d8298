// SPDX-License-Identifier: GPL-2.0-or-later
#include "fitted.h"
#include <gtest/gtest.h>

using grainscope::fit;

TEST(fitted, has_as_many_elements_as_asked_for) {
  std::vector<int> elements;
  for (std::size_t count : {0, 1, 5, 1000, 1001, 3, 0, 7}) {
    fit(elements, count);
    EXPECT_EQ(elements.size(), count);
  }
}

/** A vector that grows by one would double its room. */
TEST(fitted, has_room_for_few_more) {
  std::vector<double> elements;
  fit(elements, 1600);
  const double *at = elements.data();
  fit(elements, 1700);
  EXPECT_EQ(elements.data(), at);
  fit(elements, 1701);
  EXPECT_LE(elements.capacity(), 1701u + 1701u / 16);
  fit(elements, 100);
  EXPECT_LE(elements.capacity(), 100u + 100u / 16);
}

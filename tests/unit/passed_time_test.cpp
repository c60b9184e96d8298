// SPDX-License-Identifier: GPL-2.0-or-later
#include "passed_time.h"
#include <gtest/gtest.h>

namespace {

using grainscope::PassedTime;

TEST(passed_time, steps_of_two_lengths) {
  PassedTime time(100, 0.5);
  time.set_length(0.5, 104);
  EXPECT_EQ(time.at(110), 5.0);
  time.set_length(0.25, 110);
  EXPECT_EQ(time.at(110), 5.0);
  EXPECT_EQ(time.at(114), 6.0);
}

TEST(passed_time, another_number_of_the_step_is_no_time) {
  PassedTime time(0, 0.5);
  time.renumber(1000, 8);
  EXPECT_EQ(time.at(1000), 4.0);
  time.renumber(0, 1000);
  EXPECT_EQ(time.at(2), 5.0);
}

TEST(passed_time, goes_on_to_the_last_bit_whatever_its_step_is_called) {
  PassedTime time(3, 0.1), other(0, 7.0);
  time.set_length(0.3, 10);
  other.restore(time.state(17), 5);
  EXPECT_EQ(other.at(5), time.at(17));
  EXPECT_EQ(other.at(96), time.at(108));
}

}

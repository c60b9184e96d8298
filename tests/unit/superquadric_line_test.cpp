// SPDX-License-Identifier: GPL-2.0-or-later
#include "superquadric_line.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace line = grainscope::superquadric_line;

namespace {

std::string problem(const char *text) { return line::problem_of_grain(line::words_of(text), 2, 512); }

const std::string bare = "7 2 1000 1 1 1.5 2 2 -1.99 0 1e-3";

}

TEST(superquadric_line, words_end_with_the_line_or_a_comment) {
  EXPECT_EQ(line::words_of(" a\tb  c \n d"), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(line::words_of("a b# c"), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(line::words_of("a\r\n"), (std::vector<std::string>{"a"}));
  EXPECT_TRUE(line::words_of("").empty());
  EXPECT_TRUE(line::words_of("\n a").empty());
}

TEST(superquadric_line, columns_are_known_by_their_number) {
  for (int n = 0; n < 30; n++) {
    const int expected = n == 11 || n == 14 ? 11 : n == 15 || n == 18 ? 15 : 0;
    EXPECT_EQ(line::columns_without_images(n), expected) << n;
  }
}

TEST(superquadric_line, right_lines_are_taken) {
  for (const char *rest : {"", " 0 -512 511", " 1 0 0 0", " 0 -3 0 1e-200", " 0.5 0.5 0.5 -0.5 0 1 2"})
    EXPECT_EQ(problem((bare + rest).c_str()), "");
}

TEST(superquadric_line, problem_names_column_requirement_and_value) {
  EXPECT_EQ(problem("7 2 -1 1 1 1 2 2 0 0 0"), "'density' must be above 0, got '-1'");
  EXPECT_EQ(problem("7 2 1 1 1 1 2 1.999 0 0 0"), "'blockiness2' must be at least 2, got '1.999'");
  EXPECT_EQ(problem("7 2 1 1 1x 1 2 2 0 0 0"), "'shapey' must be a finite number, got '1x'");
  EXPECT_EQ(problem("7 2 1 1 1 1e999 2 2 0 0 0"), "'shapez' must be a finite number, got '1e999'");
  EXPECT_EQ(problem("99999999999 2 1 1 1 1 2 2 0 0 0"),
            "'id' must be a whole number from 1 to 2147483647, got '99999999999'");
  EXPECT_EQ(problem((bare + " 0 -513 0").c_str()), "'iy' must be a whole number from -512 to 511, got '-513'");
  EXPECT_EQ(problem((bare + " 0 0 -0 0").c_str()),
            "'quatw quatx quaty quatz' must be of a length above 0, got '0 0 -0 0'");
}

TEST(superquadric_line, quaternion_of_length_1_is_left_to_the_last_bit) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int n = 0; n < 10000; n++) {
    double q[4], once[4];
    for (double &c : q) c = normal(random) * std::pow(10.0, n % 200 - 100);
    line::normalise(q);
    std::copy(q, q + 4, once);
    EXPECT_NEAR(std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3])), 1.0, 4e-16);
    line::normalise(q);
    for (int k = 0; k < 4; k++) EXPECT_EQ(q[k], once[k]);
  }
}

TEST(superquadric_line, text_reads_back_as_the_same_number_and_is_short) {
  EXPECT_EQ(line::text_of(1.5), "1.5");
  EXPECT_EQ(line::text_of(0.1), "0.1");
  EXPECT_EQ(line::text_of(-2.0), "-2");
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int n = 0; n < 20000; n++) {
    const double value = std::ldexp(uniform(random), n % 2000 - 1000);
    const std::string text = line::text_of(value);
    EXPECT_EQ(std::strtod(text.c_str(), nullptr), value) << text;
    EXPECT_LE(text.size(), 24u);
  }
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(std::strtod(line::text_of(least).c_str(), nullptr), least);
}

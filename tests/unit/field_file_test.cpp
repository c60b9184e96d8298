// SPDX-License-Identifier: GPL-2.0-or-later
#include "field_file.h"
#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <locale>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace grainscope;
using Eigen::Vector3d;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN(), infinity = HUGE_VAL;

/** A table whose value in row r, column c is 100 r + c; errors are negative. */
FieldTable numbered(const std::array<int, 3> &cells, const std::vector<std::string> &names, bool errors = false) {
  FieldTable table;
  table.cells = cells;
  table.names = names;
  for (std::size_t row = 0; row < table.rows(); row++)
    for (int sign : {1, -1})
      for (std::size_t column = 0; column < names.size() && (sign > 0 || errors); column++)
        table.values.push_back(sign * (100.0 * row + column));
  return table;
}

std::string between(const std::string &text, const std::string &from, const std::string &to) {
  const std::size_t begin = text.find(from);
  EXPECT_NE(begin, std::string::npos) << from << " in\n" << text;
  if (begin == std::string::npos) return "";
  return text.substr(begin + from.size(), text.find(to, begin + from.size()) - begin - from.size());
}

/** Names and components of the arrays of cells, as name/components. */
std::vector<std::string> arrays(const std::string &vtk) {
  std::vector<std::string> found;
  std::istringstream lines(between(vtk, "<CellData>", "</CellData>"));
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("<DataArray", 0) == 0)
      found.push_back(between(line, "Name=\"", "\"") + "/" + between(line, "NumberOfComponents=\"", "\""));
  return found;
}

/** What stands in an array. */
std::string content(const std::string &vtk, const std::string &name) {
  const std::string array = between(vtk, "Name=\"" + name + "\"", "</DataArray>");
  return array.substr(array.find('\n') + 1);
}

std::vector<double> numbers(std::string text) {
  for (char &c : text)
    if (c == ',') c = ' ';
  std::vector<double> found;
  std::istringstream words(text);
  for (std::string word; words >> word;) found.push_back(std::strtod(word.c_str(), nullptr));
  return found;
}

std::string rows_of_csv(const std::string &csv) {
  std::size_t place = 0;
  for (int line = 0; line < 4; line++) place = csv.find('\n', place) + 1;
  return csv.substr(place);
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

std::vector<double> all_kinds_of_numbers() {
  using limits = std::numeric_limits<double>;
  std::vector<double> kinds = {0.0, -0.0, 0.1, 1.0 / 3.0, 1e300, limits::max(), limits::min(), limits::denorm_min()};
  std::mt19937_64 random(7);
  while (kinds.size() < 2000) {
    const std::uint64_t bits = random();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) kinds.push_back(value);
  }
  return kinds;
}

}

TEST(field_csv, has_step_time_cells_names_and_a_line_for_each_row) {
  FieldTable table = numbered({{2, 1, 1}}, {"N", "v_x"}, true);
  table.step = 20000000000;
  table.time = 0.25;
  EXPECT_EQ(field_csv(table),
            "# step 20000000000\n# time 0.25\n# cells 2 1 1\nN,v_x,N_error,v_x_error\n0,1,-0,-1\n100,101,-100,-101\n");
}

TEST(field_csv, without_errors_has_the_names_alone) {
  EXPECT_EQ(field_csv(numbered({{1, 1, 1}}, {"N", "rho"})), "# step 0\n# time 0\n# cells 1 1 1\nN,rho\n0,1\n");
}

TEST(field_csv, writes_what_is_not_finite_in_words_without_the_sign_of_nan) {
  FieldTable table = numbered({{4, 1, 1}}, {"a"});
  table.values = {nan_value, std::copysign(nan_value, -1.0), infinity, -infinity};
  EXPECT_EQ(rows_of_csv(field_csv(table)), "nan\nnan\ninf\n-inf\n");
}

TEST(field_file, numbers_come_back_to_the_last_bit) {
  const std::vector<double> kinds = all_kinds_of_numbers();
  FieldTable table = numbered({{1, 1, static_cast<int>(kinds.size())}}, {"a"});
  table.values = kinds;
  for (const std::string &text : {rows_of_csv(field_csv(table)), content(field_vti(table), "a")}) {
    const std::vector<double> found = numbers(text);
    ASSERT_EQ(found.size(), kinds.size());
    for (std::size_t k = 0; k < kinds.size(); k++) EXPECT_TRUE(same_bits(found[k], kinds[k])) << kinds[k];
  }
}

TEST(field_file, digits_are_those_of_printf) {
  const std::vector<double> kinds = all_kinds_of_numbers();
  FieldTable table = numbered({{1, 1, static_cast<int>(kinds.size())}}, {"a"});
  table.values = kinds;
  std::string expected;
  for (double value : kinds) {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.17g\n", value);
    expected += digits;
  }
  EXPECT_EQ(rows_of_csv(field_csv(table)), expected);
}

TEST(field_file, does_not_depend_on_the_locale) {
  struct Commas : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  FieldTable table = numbered({{1, 2, 1}}, {"a", "b_x"}, true);
  table.values[0] = 12345.5;
  table.values[1] = nan_value;
  table.step = 1234567;
  table.time = 0.5;
  const std::string csv = field_csv(table), vti = field_vti(table), vts = field_vts(table);
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Commas));
  for (const char *german : {"de_DE.UTF-8", "de_DE.utf8", "de_DE"})
    std::setlocale(LC_ALL, german);  // where it is there
  EXPECT_EQ(field_csv(table), csv);
  EXPECT_EQ(field_vti(table), vti);
  EXPECT_EQ(field_vts(table), vts);
  std::setlocale(LC_ALL, "C");
  std::locale::global(before);
}

TEST(field_file, refuses_tables_that_do_not_fit_together) {
  FieldTable table = numbered({{2, 1, 1}}, {"a", "b"});
  table.values.pop_back();
  EXPECT_THROW(field_csv(table), std::invalid_argument);
  table.values.resize(6);  // one and a half of 2 x 2
  EXPECT_THROW(field_vti(table), std::invalid_argument);
  FieldTable empty = numbered({{0, 1, 1}}, {"a"});
  EXPECT_THROW(field_vts(empty), std::invalid_argument);
  EXPECT_THROW(field_csv(numbered({{1, 1, 1}}, {})), std::invalid_argument);
}

TEST(field_vtk, groups_vectors_and_tensors_and_leaves_others_alone) {
  const std::vector<std::string> names = {"x",    "y",    "z",    "N",    "N_c",  "v_x",  "v_y",  "v_z",
                                          "s_xx", "s_xy", "s_xz", "s_yx", "s_yy", "s_yz", "s_zx", "s_zy",
                                          "s_zz", "Q_xx", "Q_yy", "Q_zz", "Q_xy", "Q_xz", "Q_yz", "S2"};
  const std::vector<std::string> expected = {"x/1", "y/1", "z/1", "N/1", "N_c/1", "v/3", "s/9", "Q/6", "S2/1"};
  EXPECT_EQ(arrays(field_vti(numbered({{1, 2, 1}}, names))), expected);
  EXPECT_EQ(arrays(field_vts(numbered({{1, 2, 1}}, names))), expected);
}

TEST(field_vtk, symmetric_tensors_are_in_the_order_of_vtk) {
  const FieldTable table = numbered({{2, 1, 1}}, {"F_xx", "F_yy", "F_zz", "F_xy", "F_xz", "F_yz"});
  EXPECT_EQ(content(field_vti(table), "F"), "0 1 2 3 5 4\n100 101 102 103 105 104\n");
}

TEST(field_vtk, full_tensors_are_row_by_row_whatever_the_order_of_columns) {
  const FieldTable table =
      numbered({{1, 1, 1}}, {"s_zz", "s_xx", "s_xy", "s_xz", "s_yx", "s_yy", "s_yz", "s_zx", "s_zy"});
  EXPECT_EQ(content(field_vti(table), "s"), "1 2 3 4 5 6 7 8 0\n");
}

TEST(field_vtk, incomplete_groups_stay_apart) {
  const std::vector<std::string> names = {"v_x", "v_y", "s_xx", "s_yy", "s_zz", "s_xy", "s_xz", "s_yz", "s_zy", "_x"};
  EXPECT_EQ(arrays(field_vti(numbered({{1, 1, 1}}, names))).size(), names.size());
}

TEST(field_vtk, components_of_a_column_that_has_their_name_stay_apart) {
  const FieldTable table = numbered({{1, 1, 1}}, {"T_x", "T_y", "T_z", "T"});
  EXPECT_EQ(arrays(field_vti(table)), (std::vector<std::string>{"T_x/1", "T_y/1", "T_z/1", "T/1"}));
}

TEST(field_vtk, errors_are_arrays_beside_the_values) {
  const std::string text = field_vti(numbered({{2, 1, 1}}, {"N", "v_x", "v_y", "v_z"}, true));
  EXPECT_EQ(arrays(text), (std::vector<std::string>{"N/1", "N_error/1", "v/3", "v_error/3"}));
  EXPECT_EQ(content(text, "v"), "1 2 3\n101 102 103\n");
  EXPECT_EQ(content(text, "v_error"), "-1 -2 -3\n-101 -102 -103\n");
}

TEST(field_vtk, writes_what_is_not_finite_in_words) {
  FieldTable table = numbered({{3, 1, 1}}, {"a"});
  table.values = {std::copysign(nan_value, -1.0), infinity, -infinity};
  EXPECT_EQ(content(field_vti(table), "a"), "nan\ninf\n-inf\n");
  EXPECT_EQ(content(field_vts(table), "a"), "nan\ninf\n-inf\n");
}

TEST(field_vtk, cells_have_x_fastest) {
  EXPECT_EQ(numbers(content(field_vti(numbered({{2, 3, 2}}, {"a"})), "a")),
            (std::vector<double>{0, 100, 200, 300, 400, 500, 600, 700, 800, 900, 1000, 1100}));
}

TEST(field_vti, has_the_extent_origin_and_spacing_of_the_grid) {
  FieldTable table = numbered({{2, 4, 5}}, {"a"});
  table.corner = Vector3d(-1.0, 0.5, 0.0);
  table.edges.diagonal() = Vector3d(3.0, 1.0, 10.0);
  table.time = 1e-05;
  const std::string text = field_vti(table);
  EXPECT_NE(text.find("<ImageData WholeExtent=\"0 2 0 4 0 5\" Origin=\"-1 0.5 0\" Spacing=\"1.5 0.25 2\">"),
            std::string::npos);
  EXPECT_NE(text.find("<Piece Extent=\"0 2 0 4 0 5\">"), std::string::npos);
  EXPECT_EQ(numbers(between(text, "Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">", "<")),
            std::vector<double>{1e-05});
}

TEST(field_vti, refuses_a_tilted_grid) {
  FieldTable table = numbered({{2, 2, 1}}, {"a"});
  EXPECT_TRUE(is_orthogonal(table));
  table.edges(0, 1) = 1e-14;  // rounding
  EXPECT_TRUE(is_orthogonal(table));
  table.edges(0, 1) = 1e-3;
  EXPECT_FALSE(is_orthogonal(table));
  EXPECT_THROW(field_vti(table), std::invalid_argument);
  EXPECT_EQ(arrays(field_vts(table)), std::vector<std::string>{"a/1"});
}

TEST(field_vts, points_of_a_tilted_grid_have_x_fastest) {
  FieldTable table = numbered({{2, 1, 1}}, {"a"});
  table.corner = Vector3d(1.0, 2.0, 3.0);
  table.edges << 4.0, 1.0, 0.5, 0.0, 2.0, 0.25, 0.0, 0.0, 3.0;
  const std::string text = field_vts(table);
  EXPECT_EQ(content(text, "Points"), "1 2 3\n3 2 3\n5 2 3\n2 4 3\n4 4 3\n6 4 3\n"
                                     "1.5 2.25 6\n3.5 2.25 6\n5.5 2.25 6\n2.5 4.25 6\n4.5 4.25 6\n6.5 4.25 6\n");
  EXPECT_NE(text.find("<StructuredGrid WholeExtent=\"0 2 0 1 0 1\">"), std::string::npos);
}

TEST(field_vts, ends_at_the_far_corner_exactly) {
  FieldTable table = numbered({{3, 7, 1}}, {"a"});
  table.edges.diagonal() = Vector3d(0.1, 0.7, 0.3);
  const std::vector<double> points = numbers(content(field_vts(table), "Points"));
  ASSERT_EQ(points.size(), 3u * 4 * 8 * 2);
  EXPECT_EQ(Vector3d(points.end()[-3], points.end()[-2], points.end()[-1]), Vector3d(0.1, 0.7, 0.3));
}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "superquadric_line.h"
#include <cerrno>
#include <climits>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace grainscope { namespace superquadric_line {
namespace {

enum Column { id, type, density, shape, blockiness = 6, position = 8, orientation = bare };

const char *const names[] = {"id", "type", "density", "shapex", "shapey", "shapez", "blockiness1", "blockiness2",
                             "x",  "y",    "z",       "quatw",  "quatx",  "quaty",  "quatz"};
const char *const image_names[] = {"ix", "iy", "iz"};
const char *const velocity_names[] = {"id", "vx", "vy", "vz", "omegax", "omegay", "omegaz"};

bool is_finite_number(const std::string &word, double &value) {
  char *end = nullptr;
  value = std::strtod(word.c_str(), &end);
  return end != word.c_str() && !*end && std::isfinite(value);
}

bool is_whole_number(const std::string &word, long low, long high) {
  char *end = nullptr;
  errno = 0;
  const long value = std::strtol(word.c_str(), &end, 10);
  return end != word.c_str() && !*end && errno == 0 && low <= value && value <= high;
}

std::string wrong(const std::string &name, const std::string &requirement, const std::string &got) {
  return "'" + name + "' must be " + requirement + ", got '" + got + "'";
}

std::string whole_number_between(const std::string &name, const std::string &word, long low, long high) {
  if (is_whole_number(word, low, high)) return "";
  return wrong(name, "a whole number from " + std::to_string(low) + " to " + std::to_string(high), word);
}

std::string problem_of_number(int column, const std::string &word, double &value) {
  if (!is_finite_number(word, value)) return wrong(names[column], "a finite number", word);
  if (column >= density && column < blockiness && value <= 0.0) return wrong(names[column], "above 0", word);
  if (column >= blockiness && column < position && value < 2.0) return wrong(names[column], "at least 2", word);
  return "";
}

}

std::vector<std::string> words_of(const char *line) {
  std::vector<std::string> words;
  std::string word;
  for (const char *c = line;; c++) {
    const bool ends = !*c || *c == '\n' || *c == '#';
    if (!ends && *c != ' ' && *c != '\t' && *c != '\r' && *c != '\f') {
      word += *c;
      continue;
    }
    if (!word.empty()) words.push_back(word);
    word.clear();
    if (ends) return words;
  }
}

int columns_without_images(int words) {
  for (int columns : {bare, bare + quaternion})
    if (words == columns || words == columns + images) return columns;
  return 0;
}

std::string problem_of_grain(const std::vector<std::string> &words, int types, int images_limit) {
  const int columns = columns_without_images(words.size());
  if (!columns)
    return "expected 11, 14, 15 or 18 columns (id type density shapex shapey shapez blockiness1 blockiness2 x y z, "
           "then, if wanted, quatw quatx quaty quatz, then, if wanted, ix iy iz), got " +
           std::to_string(words.size());
  std::string problem = whole_number_between("id", words[id], 1, INT_MAX);
  if (problem.empty()) problem = whole_number_between("type", words[type], 1, types);
  double length = 0.0;
  for (int k = density; k < columns && problem.empty(); k++) {
    double value = 0.0;
    problem = problem_of_number(k, words[k], value);
    if (k >= orientation) length = std::hypot(length, value);
  }
  if (problem.empty() && columns > bare && !(length > 0.0 && std::isfinite(length)))
    problem = wrong("quatw quatx quaty quatz", "of a length above 0",
                    words[bare] + " " + words[bare + 1] + " " + words[bare + 2] + " " + words[bare + 3]);
  for (int k = columns; k < static_cast<int>(words.size()) && problem.empty(); k++)
    problem = whole_number_between(image_names[k - columns], words[k], -images_limit, images_limit - 1);
  return problem;
}

std::string problem_of_velocity(const std::vector<std::string> &words) {
  if (words.size() != velocity)
    return "expected 7 columns (id vx vy vz omegax omegay omegaz), got " + std::to_string(words.size());
  std::string problem = whole_number_between("id", words[id], 1, INT_MAX);
  double value = 0.0;
  for (int k = 1; k < velocity && problem.empty(); k++)
    if (!is_finite_number(words[k], value)) problem = wrong(velocity_names[k], "a finite number", words[k]);
  return problem;
}

void normalise(double *q) {
  const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  if (std::fabs(length - 1.0) <= 4.0 * std::numeric_limits<double>::epsilon()) return;
  for (int k = 0; k < 4; k++) q[k] /= length;
}

std::string text_of(double value) {
  char text[32];
  for (int digits = 15; digits <= 17; digits++) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    if (std::strtod(text, nullptr) == value) break;
  }
  return text;
}

}}

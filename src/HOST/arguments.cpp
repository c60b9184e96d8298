// SPDX-License-Identifier: GPL-2.0-or-later
#include "arguments.h"
#include "nearest_name.h"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace grainscope {

namespace {

const std::size_t shortest_guess = 2;  // letters: of such a word any other is near

}

Arguments::Arguments(LAMMPS_NS::LAMMPS *lmp, const std::string &style, int first, int narg, char **arg)
    : lmp_(lmp), style_(style), words_(arg + std::min(first, narg), arg + narg) {}

std::string Arguments::word(const std::string &wanted) {
  if (done())
    fail("expected " + wanted + (at_ ? " after '" + words_[at_ - 1] + "'" : "") + ", got the end of the command");
  return words_[at_++];
}

std::string Arguments::keyword(const std::vector<std::string> &keywords, const std::string &kind,
                               const std::string &many) {
  std::string got = choice(kind, keywords);
  if (!keywords_.insert(got).second && got != many) fail("'" + got + "' is given twice");
  return got;
}

std::vector<std::string> Arguments::words_before(const std::vector<std::string> &keywords, const std::string &wanted) {
  std::vector<std::string> found;
  const auto at_keyword = [&] {
    return !done() && std::find(keywords.begin(), keywords.end(), words_[at_]) != keywords.end();
  };
  if (at_keyword()) fail("expected " + wanted + " after '" + words_[at_ - 1] + "', got '" + words_[at_] + "'");
  do found.push_back(word(wanted));
  while (!done() && !at_keyword());
  return found;
}

void Arguments::require_none() {
  if (!done()) fail("takes no keywords, got '" + words_[at_] + "'");
}

std::string Arguments::choice(const std::string &keyword, const std::vector<std::string> &choices) {
  std::string list;
  for (std::size_t k = 0; k < choices.size(); k++)
    list += (k == 0 ? "" : k + 1 < choices.size() ? ", " : " or ") + choices[k];
  std::string got = word(list);
  for (const std::string &one : choices)
    if (got == one) return got;
  const std::string nearest = got.size() > shortest_guess ? nearest_name(got, choices) : "";
  fail("'" + keyword + "' must be " + list + ", got '" + got + "'" + nearest);
}

bool Arguments::is_number(const std::string &text, double &value) {
  char *end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return !text.empty() && text.find_first_not_of("0123456789+-.eE") == std::string::npos && *end == '\0' &&
         std::isfinite(value);
}

std::string Arguments::text(double value) {
  if (std::isnan(value)) return "nan";  // whatever its sign
  char written[32];
  snprintf(written, sizeof written, "%g", value);
  return written;
}

double Arguments::number(const std::string &keyword, const std::string &requirement, bool (*accept)(double)) {
  const std::string got = word(requirement);
  double value;
  if (!is_number(got, value) || !accept(value)) fail(keyword, requirement, got);
  return value;
}

int Arguments::multiple(const std::string &keyword, int of, int low, int high, const std::string &what) {
  const std::string requirement = what + " from " + std::to_string(low) + " to " + std::to_string(high);
  const std::string got = word(requirement);
  double value;
  if (!is_number(got, value) || value < low || value > high || value != of * std::floor(value / of))
    fail(keyword, requirement, got);
  return static_cast<int>(value);
}

int Arguments::whole_number(const std::string &keyword, int low, int high) {
  return multiple(keyword, 1, low, high, "a whole number");
}

int Arguments::even_number(const std::string &keyword, int low, int high) {
  return multiple(keyword, 2, low, high, "an even whole number");
}

void Arguments::fail(const std::string &keyword, const std::string &requirement, const std::string &got) const {
  fail("'" + keyword + "' must be " + requirement + ", got '" + got + "'");
}

void Arguments::fail(const std::string &message) const { end_run(lmp_, style_ + ": " + message); }

}

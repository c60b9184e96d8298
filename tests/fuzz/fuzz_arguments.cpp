// SPDX-License-Identifier: GPL-2.0-or-later
#include "arguments.h"
#include "input.h"
#include "plane.h"
#include "two_dimensions.h"
#include <algorithm>
#include <string>
#include <vector>

using grainscope::Arguments;

namespace {

struct Refused {
  std::string message;
};

const std::string style = "compute of/words";

/** The words of a deck's line: whatever is not a blank. */
std::vector<std::string> split(fuzz::Input &input) {
  std::vector<std::string> words(1);
  while (!input.empty()) {
    const char c = static_cast<char>(input.byte());
    if (c == ' ' || c == '\0' || c == '\n') words.emplace_back();
    else words.back() += c;
  }
  return words;
}

void require_number(const std::string &text) {
  double value = 0.0;
  if (!Arguments::is_number(text, value)) return;
  fuzz::require(std::isfinite(value), "a number is finite", value);
  fuzz::require(!text.empty() && text.find_first_of(" \t\n") == std::string::npos, "a number is a word");
  char again[64];
  std::snprintf(again, sizeof again, "%.17g", value);
  double same = 0.0;
  fuzz::require(Arguments::is_number(again, same) && same == value, "a number that is printed is the same number",
                same);
}

bool is_positive(double x) { return x > 0.0; }

/** Reads as a style would: what comes back keeps what was asked for. */
void read_one(Arguments &arguments, unsigned how) {
  if (how % 7 == 0) arguments.word("a word");
  if (how % 7 == 1) {
    const std::vector<std::string> choices = {"xy", "xz", "yz", ""};
    const std::string got = arguments.choice("keyword", choices);
    fuzz::require(std::find(choices.begin(), choices.end(), got) != choices.end(), "a choice is one of those given");
  }
  if (how % 7 == 2)
    fuzz::require(arguments.number("number", "a positive length", is_positive) > 0.0, "a number is accepted");
  if (how % 7 == 3) {
    const int low = how & 8u ? -3 : 1, high = how & 16u ? 10000 : 2147483647,
              got = arguments.whole_number("whole", low, high);
    fuzz::require(low <= got && got <= high, "a whole number is in its range", got);
  }
  if (how % 7 == 4) {
    const int got = arguments.even_number("even", 2, 1000);
    fuzz::require(2 <= got && got <= 1000 && got % 2 == 0, "an even number is", got);
  }
  if (how % 7 == 5) arguments.yes_or_no("flag");
  if (how % 7 == 6) {
    grainscope::Plane plane;
    plane.read(arguments);
    fuzz::require(plane.flow + plane.gradient + plane.vorticity == 3 && plane.flow != plane.gradient &&
                      plane.vorticity >= 0,
                  "a plane has three different axes", plane.vorticity);
  }
}

}

void grainscope::end_run(LAMMPS_NS::LAMMPS *, const std::string &message) { throw Refused{message}; }
/** As in three dimensions. */
void grainscope::require_axes_of_plane(LAMMPS_NS::LAMMPS *, const Arguments &, const std::string &, const std::string &,
                                       const std::string &) {}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzz::Input input(data, size);
  unsigned plan[16];
  for (unsigned &how : plan) how = input.byte();
  const int first = input.whole(0, 5);
  std::vector<std::string> words = split(input);
  for (const std::string &word : words) require_number(word);
  std::vector<char *> pointers;
  for (std::string &word : words) pointers.push_back(&word[0]);
  const int all = static_cast<int>(words.size());

  Arguments arguments(nullptr, style, first, all, pointers.data());
  int asked = 0;
  try {
    for (; !arguments.done(); asked++) read_one(arguments, plan[asked % 16]);
    fuzz::require(asked == std::max(all - first, 0), "every word is read once", asked);
    read_one(arguments, plan[asked % 16]);
    fuzz::require(false, "the end of a command is refused");
  } catch (const Refused &refused) {
    const std::string &said = refused.message;
    fuzz::require(said.compare(0, style.size() + 2, style + ": ") == 0, "a problem names the style");
    const std::string got = arguments.done() && said.find("got the end of the command") != std::string::npos
                                ? "the end of the command"
                                : "'" + words[std::min(first + asked, all - 1)] + "'";
    const std::size_t at = said.rfind(", got " + got);
    fuzz::require(at != std::string::npos, "a problem says what it got");
    const std::string after = said.substr(at + 6 + got.size());  // nothing, or the nearest choice
    fuzz::require(after.empty() || after.compare(0, 15, ": did you mean ") == 0,
                  "a problem ends with what it got, or what is near it");
  }
  return 0;
}

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ARGUMENTS_H
#define GRAINSCOPE_ARGUMENTS_H

#include <set>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace grainscope {

/** Ends the run on all ranks with `message`. In a file of its own, because the fuzzer builds the reader of words
 *  without LIGGGHTS. */
[[noreturn]] void end_run(LAMMPS_NS::LAMMPS *lmp, const std::string &message);

/** The words of one command, read in order. Every error names the style, the keyword, the requirement and the value
 *  received: `compute dissipation: 'mode' must be instantaneous or step, got 'fast'`. Errors are collective: all ranks
 *  read the same words. */
class Arguments {
 public:
  Arguments(LAMMPS_NS::LAMMPS *lmp, const std::string &style, int first, int narg, char **arg);
  /** For errors alone, when the words have been read. */
  Arguments(LAMMPS_NS::LAMMPS *lmp, const std::string &style) : lmp_(lmp), style_(style) {}

  LAMMPS_NS::LAMMPS *host() const { return lmp_; }
  bool done() const { return at_ == words_.size(); }
  /** The next word; an error that names `wanted` when there is none. */
  std::string word(const std::string &wanted);
  /** The next keyword (or, for messages, the next `kind` of word), one of `keywords`; an error when it was read
   *  before, unless it is `many`. */
  std::string keyword(const std::vector<std::string> &keywords, const std::string &kind = "keyword",
                      const std::string &many = "");
  /** The words up to the next of `keywords`, at least one. */
  std::vector<std::string> words_before(const std::vector<std::string> &keywords, const std::string &wanted);
  /** For a style without keywords: an error when there is a word. */
  void require_none();
  /** The value that follows `keyword`, as one of `choices`. */
  std::string choice(const std::string &keyword, const std::vector<std::string> &choices);
  bool yes_or_no(const std::string &keyword) { return choice(keyword, {"yes", "no"}) == "yes"; }
  /** A finite number, the whole word. The error gives `requirement` if it is not one, or if `accept` is false for it.
   */
  double number(const std::string &keyword, const std::string &requirement, bool (*accept)(double));
  /** A whole number from `low` to `high`. */
  int whole_number(const std::string &keyword, int low, int high);
  /** The same, even. */
  int even_number(const std::string &keyword, int low, int high);
  /** `text` as a finite decimal number; false when it is not one to the last character. */
  static bool is_number(const std::string &text, double &value);
  /** `value` for messages, small or large, to six digits. */
  static std::string text(double value);

  [[noreturn]] void fail(const std::string &keyword, const std::string &requirement, const std::string &got) const;
  [[noreturn]] void fail(const std::string &message) const;

 private:
  LAMMPS_NS::LAMMPS *lmp_;
  std::string style_;
  std::vector<std::string> words_;
  std::size_t at_ = 0;
  std::set<std::string> keywords_;  // read so far

  int multiple(const std::string &keyword, int of, int low, int high, const std::string &what);
};

}

#endif

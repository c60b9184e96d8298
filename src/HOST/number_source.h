// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_NUMBER_SOURCE_H
#define GRAINSCOPE_NUMBER_SOURCE_H

#include "pointers.h"
#include <string>

namespace grainscope {

class Arguments;

/** A positive number of an input script: a number, or an equal-style variable that is evaluated when the number is
 *  needed. */
class NumberSource : private LAMMPS_NS::Pointers {
 public:
  /** For messages: the style, the keyword, and all that may follow it. */
  NumberSource(LAMMPS_NS::LAMMPS *lmp, const std::string &style, const std::string &keyword,
               const std::string &requirement)
      : Pointers(lmp), style_(style), keyword_(keyword), requirement_(requirement) {}

  /** Takes `word`: a number or v_name. */
  void set(const Arguments &errors, const std::string &word);
  bool given() const { return !text_.empty(); }
  /** An error when the variable is not there. Before each run. */
  void init() const;
  /** The number now, positive and finite. Collective. */
  double now() const;

 private:
  std::string style_, keyword_, requirement_;
  std::string text_;  // as given; empty: nothing was
  double number_ = 0.0;

  bool is_variable() const { return text_.compare(0, 2, "v_") == 0; }
  int variable() const;
};

}

#endif

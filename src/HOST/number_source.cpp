// SPDX-License-Identifier: GPL-2.0-or-later
#include "number_source.h"
#include "arguments.h"
#include "input.h"
#include "variable.h"
#include <cmath>

namespace grainscope {

void NumberSource::set(const Arguments &errors, const std::string &word) {
  text_ = word;
  if (is_variable() ? word.size() > 2 : Arguments::is_number(word, number_) && number_ > 0.0) return;
  errors.fail(keyword_, requirement_, word);
}

int NumberSource::variable() const {
  const int found = input->variable->find(const_cast<char *>(text_.c_str() + 2));
  if (found < 0 || !input->variable->equalstyle(found))
    Arguments(lmp, style_).fail(keyword_, "an equal-style variable that is defined", text_);
  return found;
}

void NumberSource::init() const {
  if (given() && is_variable()) variable();
}

double NumberSource::now() const {
  if (!is_variable()) return number_;
  const double value = input->variable->compute_equal(variable());
  if (!(value > 0.0) || !std::isfinite(value))
    Arguments(lmp, style_).fail(keyword_, "a positive number", text_ + " = " + Arguments::text(value));
  return value;
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "strain_source.h"
#include "arguments.h"
#include "bin_index.h"
#include "fix_press_strain.h"
#include "input.h"
#include "modify.h"
#include "variable.h"
#include <cmath>

namespace grainscope {

namespace {

const char *const requirement = "f_ID[n], v_name or time";

}

void StrainSource::read(Arguments &arguments) {
  text_ = arguments.word(requirement);
  if (is_time()) return;
  if (text_.size() > 2 && text_.compare(0, 2, "v_") == 0) {
    name_ = text_.substr(2);
    return;
  }
  const std::size_t open = text_.find('['), close = text_.size() - 1;
  double element = 0.0;
  const bool element_given = text_.compare(0, 2, "f_") == 0 && open != std::string::npos && open > 2 &&
                             text_[close] == ']' &&
                             Arguments::is_number(text_.substr(open + 1, close - open - 1), element);
  element_ = element_given ? static_cast<int>(whole_count(element, 1e6)) - 1 : -1;
  if (element_ < 0) arguments.fail("strain", requirement, text_);
  name_ = text_.substr(2, open - 2);
}

void StrainSource::find_press_strain(const Arguments &errors) {
  for (int k = 0; k < modify->nfix; k++) {
    if (!dynamic_cast<LAMMPS_NS::FixPressStrain *>(modify->fix[k])) continue;
    if (fix_) errors.fail("there are several fixes press/strain: name the one that gives the strain, 'strain f_ID[1]'");
    fix_ = modify->fix[k];
  }
  if (!fix_) errors.fail("needs a strain: use fix press/strain, or the keyword 'strain' with f_ID[n], v_name or time");
}

void StrainSource::init() {
  find(Arguments(lmp, style_));
  ready_ = true;
}

void StrainSource::find(const Arguments &errors) {
  fix_ = nullptr;
  variable_ = -1;
  if (is_time()) return;
  if (text_.empty()) {
    find_press_strain(errors);
  } else if (text_[0] == 'v') {
    variable_ = input->variable->find(const_cast<char *>(name_.c_str()));
    if (variable_ < 0 || !input->variable->equalstyle(variable_))
      errors.fail("strain", "an equal-style variable that is defined", text_);
  } else {
    const int found = modify->find_fix(name_.c_str());
    if (found < 0) errors.fail("strain", "the element of a fix that is defined", text_);
    fix_ = modify->fix[found];
    if (!fix_->vector_flag || element_ >= fix_->size_vector)
      errors.fail("strain", "an element of the fix's vector", text_);
  }
}

double StrainSource::now(double passed_time) {
  const Arguments errors(lmp, style_);
  if (!ready_) errors.fail("was not set up: do not use 'pre no' in the first run with it");
  find(errors);  // again: `run every` may have changed what there is
  if (is_time()) return passed_time;
  const double strain = fix_ ? fix_->compute_vector(element_) : input->variable->compute_equal(variable_);
  if (!std::isfinite(strain)) errors.fail("strain", "finite", text_ + " = " + Arguments::text(strain));
  return strain;
}

}

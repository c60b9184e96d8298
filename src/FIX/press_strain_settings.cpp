// SPDX-License-Identifier: GPL-2.0-or-later
#include "press_strain_settings.h"
#include "arguments.h"
#include "two_dimensions.h"
#include "domain.h"
#include "input.h"
#include "variable.h"
#include <cmath>
#include <set>

namespace grainscope {

namespace {

/** Value of the variable that `keyword` names. */
double value_of(LAMMPS_NS::LAMMPS *lmp, const char *keyword, const Quantity &quantity) {
  const int found = lmp->input->variable->find(const_cast<char *>(quantity.variable.c_str()));
  if (found < 0 || !lmp->input->variable->equalstyle(found))
    press_strain_error(lmp, std::string("'") + keyword + "' must name an equal-style variable, got 'v_" +
                                quantity.variable +
                                (found < 0 ? "', which does not exist" : "', which is of another style"));
  return lmp->input->variable->compute_equal(found);
}

bool positive(double x) { return x > 0.0; }

Quantity read_quantity(Arguments &arguments, const std::string &keyword, const std::string &requirement,
                       bool (*accept)(double)) {
  Quantity quantity;
  const std::string word = arguments.word(requirement);
  if (word.size() > 2 && word.compare(0, 2, "v_") == 0) quantity.variable = word.substr(2);
  else if (!Arguments::is_number(word, quantity.value) || !accept(quantity.value))
    arguments.fail(keyword, requirement, word);
  return quantity;
}

void read_shear(Arguments &arguments, PressStrainSettings &my) {
  const std::string name = arguments.choice("shear", {"xy", "xz", "yz"});
  require_axes_of_plane(arguments.host(), arguments, "shear", "xy", name);
  for (const Tilt &tilt : tilts)
    if (name == tilt.name) my.shear = &tilt;
  const std::string word = arguments.word("'rate' and a shear rate");
  if (word != "rate")
    arguments.fail("'shear " + name + "' must be followed by 'rate' and a shear rate, got '" + word + "'");
  my.rate = read_quantity(arguments, "rate", "a shear rate other than 0 or a variable v_name",
                          [](double x) { return x != 0.0; });
}

void read_interval(Arguments &arguments, const std::string &keyword, PressStrainSettings &my) {
  using Every = PressStrainSettings::Every;
  my.every = keyword == "every" ? Every::strain : keyword == "every/time" ? Every::time : Every::step;
  my.interval = my.every == Every::step
                    ? arguments.number(keyword, "a whole number of steps >= 1",
                                       [](double x) { return x >= 1.0 && x == std::floor(x); })
                    : arguments.number(keyword, my.every == Every::strain ? "a strain > 0" : "a time > 0", positive);
}

void read_gain(Arguments &arguments, PressureControl &control) {
  const std::string requirement = "auto or a velocity per pressure >= 0", word = arguments.word(requirement);
  control.automatic = word == "auto";
  if (!control.automatic && (!Arguments::is_number(word, control.gain) || control.gain < 0.0))
    arguments.fail("gain", requirement, word);
}

}

void press_strain_error(LAMMPS_NS::LAMMPS *lmp, const std::string &message) {
  Arguments(lmp, "fix press/strain").fail(message);
}

PressStrainSettings::PressStrainSettings(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) {
  Arguments arguments(lmp, "fix press/strain", 3, narg, arg);
  std::set<std::string> given;
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword({"axis", "target", "shear", "every", "every/time", "every/step",
                                                   "gain", "limit", "maxrate", "momentum", "kinetic"});
    const std::string kind = keyword.compare(0, 6, "every/") == 0 ? "every" : keyword;
    if (!given.insert(kind).second)
      arguments.fail("'every', 'every/time' and 'every/step' exclude each other, got a second one: '" + keyword + "'");
    if (keyword == "axis") {
      const std::string name = arguments.choice(keyword, {"x", "y", "z"});
      require_axes_of_plane(lmp, arguments, keyword, "x or y", name);
      axis = name[0] - 'x';
    } else if (keyword == "target")
      target =
          read_quantity(arguments, keyword, "a pressure >= 0 or a variable v_name", [](double x) { return x >= 0.0; });
    else if (keyword == "shear") read_shear(arguments, *this);
    else if (keyword == "every" || keyword == "every/time" || keyword == "every/step")
      read_interval(arguments, keyword, *this);
    else if (keyword == "gain") read_gain(arguments, control);
    else if (keyword == "limit")
      control.limit =
          arguments.number(keyword, "between 0 and 1, both excluded", [](double x) { return x > 0.0 && x < 1.0; });
    else if (keyword == "maxrate") control.max_rate = arguments.number(keyword, "a rate > 0", positive);
    else if (keyword == "momentum") remove_momentum = arguments.yes_or_no(keyword);
    else kinetic = arguments.yes_or_no(keyword);
  }
  max_rate_given = given.count("maxrate");
  if (!given.count("axis")) arguments.fail("'axis x', 'axis y' or 'axis z' is required");
  if (!given.count("target")) arguments.fail("'target' and a pressure are required");
  if (given.count("every") && every == Every::strain && !shear)
    arguments.fail("'every' counts strain, and without 'shear' the box has none: use 'every/time' or 'every/step'");
  if (!given.count("every"))
    arguments.fail(shear ? "'every', 'every/time' or 'every/step' is required"
                         : "without 'shear', 'every/time' or 'every/step' is required");
  if (shear && !lmp->domain->triclinic)
    arguments.fail("'shear' needs a triclinic box: add 'change_box all triclinic' after the grains are in");
}

void PressStrainSettings::evaluate_rate(LAMMPS_NS::LAMMPS *lmp) {
  if (!shear) return;
  if (!rate.variable.empty()) rate.value = value_of(lmp, "rate", rate);
  if (rate.value == 0.0 || !std::isfinite(rate.value))
    press_strain_error(lmp, "'rate' must be a shear rate other than 0, got v_" + rate.variable + " = " +
                                Arguments::text(rate.value));
  if (!max_rate_given) control.max_rate = std::fabs(rate.value);
}

void PressStrainSettings::evaluate_target(LAMMPS_NS::LAMMPS *lmp) {
  if (!target.variable.empty()) target.value = value_of(lmp, "target", target);
  if (!(target.value >= 0.0) || !std::isfinite(target.value))
    press_strain_error(lmp, "'target' must be a pressure >= 0, got v_" + target.variable + " = " +
                                Arguments::text(target.value));
}

}

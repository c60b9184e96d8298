// SPDX-License-Identifier: GPL-2.0-or-later
#include "press_strain_settings.h"
#include "arguments.h"
#include "two_dimensions.h"
#include "domain.h"
#include "input.h"
#include "update.h"
#include "variable.h"
#include <algorithm>
#include <cmath>
#include <set>

namespace grainscope {

namespace {

using How = BoxMotion::How;

const double largest_step = 0.1;  // of an edge or a tilt, relative to the edge: a mistake in the units of a rate

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
bool not_negative(double x) { return x >= 0.0; }
bool not_zero(double x) { return x != 0.0; }
bool any(double) { return true; }

Quantity read_quantity(Arguments &arguments, const std::string &keyword, const std::string &requirement,
                       bool (*accept)(double)) {
  Quantity quantity;
  const std::string word = arguments.word(requirement);
  if (word.size() > 2 && word.compare(0, 2, "v_") == 0) quantity.variable = word.substr(2);
  else if (!Arguments::is_number(word, quantity.value) || !accept(quantity.value))
    arguments.fail(keyword, requirement, word);
  return quantity;
}

Quantity read_pressure(Arguments &arguments, const std::string &keyword) {
  return read_quantity(arguments, keyword, "a pressure >= 0 or a variable v_name", not_negative);
}

std::string got(const Quantity &quantity) {
  return ", got " + (quantity.variable.empty() ? "" : "v_" + quantity.variable + " = ") +
         Arguments::text(quantity.value);
}

}

const char *name_of_box_mode(int mode) {
  static const char *const names[number_of_box_modes] = {"x", "y", "z", "yz", "xz", "xy"};
  return names[mode];
}

void press_strain_error(LAMMPS_NS::LAMMPS *lmp, const std::string &message) {
  Arguments(lmp, "fix press/strain").fail(message);
}

/** After x, y or z. */
void PressStrainSettings::read_edge(Arguments &arguments, int edge) {
  const std::string name = name_of_box_mode(edge);
  require_axes_of_plane(arguments.host(), arguments, "axis", "x or y", name);
  BoxMotion &motion = motions[edge];
  const std::string how = arguments.choice(name, {"target", "rate", "fixed"});
  const std::string word = name + " " + how;
  if (how == "target") motion = {How::target, read_pressure(arguments, word), 1.0, true, word};
  else if (how == "rate")
    motion = {How::rate, read_quantity(arguments, word, "a rate or a variable v_name", any), 1.0, true, word};
  else motion = {How::still, Quantity(), 1.0, true, word};
}

void PressStrainSettings::read_shear(Arguments &arguments) {
  const std::string name = arguments.choice("shear", {"xy", "xz", "yz"});
  require_axes_of_plane(arguments.host(), arguments, "shear", "xy", name);
  const auto named = [&](const Tilt &tilt) { return name == tilt.name; };
  BoxMotion &motion = motions[std::find_if(std::begin(tilts), std::end(tilts), named)->index];
  if (motion.given) arguments.fail("'shear' is given twice");
  const std::string wanted = "'rate' and a shear rate, 'target' and a shear stress, or 'fixed'";
  const std::string how = arguments.word(wanted);
  const std::string word = "shear " + name + " target";
  if (how == "rate")
    motion = {How::rate, read_quantity(arguments, "rate", "a shear rate other than 0 or a variable v_name", not_zero),
              1.0, true, "rate"};
  else if (how == "target")
    motion = {How::target, read_quantity(arguments, word, "a shear stress or a variable v_name", any), 1.0, true, word};
  else if (how == "fixed") motion = {How::still, Quantity(), 1.0, true, word};
  else arguments.fail("'shear " + name + "' must be followed by " + wanted + ", got '" + how + "'");
}

/** After `mean`; which edges move with it is known when all words are read. */
void PressStrainSettings::read_mean(Arguments &arguments) {
  arguments.choice("mean", {"target"});
  has_mean = true;
  mean = read_pressure(arguments, "mean target");
}

void PressStrainSettings::read_interval(Arguments &arguments, const std::string &keyword) {
  every = keyword == "every" ? Every::strain : keyword == "every/time" ? Every::time : Every::step;
  interval = every == Every::step
                 ? arguments.number(keyword, "a whole number of steps >= 1",
                                    [](double x) { return x >= 1.0 && x == std::floor(x); })
                 : arguments.number(keyword, every == Every::strain ? "a strain > 0" : "a time > 0", positive);
}

void PressStrainSettings::read_gain(Arguments &arguments) {
  const std::string requirement = "auto or a velocity per pressure >= 0", word = arguments.word(requirement);
  control.automatic = word == "auto";
  if (!control.automatic && (!Arguments::is_number(word, control.gain) || control.gain < 0.0))
    arguments.fail("gain", requirement, word);
}

PressStrainSettings::PressStrainSettings(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) {
  Arguments arguments(lmp, "fix press/strain", 3, narg, arg);
  std::set<std::string> given;
  Words words;
  while (!arguments.done()) {
    const std::string keyword =
        arguments.keyword({"axis", "target", "x", "y", "z", "mean", "ratio", "shear", "every", "every/time",
                           "every/step", "gain", "limit", "maxrate", "momentum", "kinetic"},
                          "keyword", "shear");
    const std::string kind = keyword.compare(0, 6, "every/") == 0 ? "every" : keyword;
    if (!given.insert(kind).second && kind == "every")
      arguments.fail("'every', 'every/time' and 'every/step' exclude each other, got a second one: '" + keyword + "'");
    if (keyword == "axis") {
      const std::string name = arguments.choice(keyword, {"x", "y", "z"});
      require_axes_of_plane(lmp, arguments, keyword, "x or y", name);
      words.axis = name[0] - 'x';
    } else if (keyword == "target") words.target = read_pressure(arguments, keyword);
    else if (keyword == "x" || keyword == "y" || keyword == "z") read_edge(arguments, keyword[0] - 'x');
    else if (keyword == "mean") read_mean(arguments);
    else if (keyword == "ratio")
      for (double &one : words.ratios)
        one = arguments.number(keyword, "three numbers >= 0, of x, y and z", not_negative);
    else if (keyword == "shear") read_shear(arguments);
    else if (kind == "every") read_interval(arguments, keyword);
    else if (keyword == "gain") read_gain(arguments);
    else if (keyword == "limit")
      control.limit =
          arguments.number(keyword, "between 0 and 1, both excluded", [](double x) { return x > 0.0 && x < 1.0; });
    else if (keyword == "maxrate") control.max_rate = arguments.number(keyword, "a rate > 0", positive);
    else if (keyword == "momentum") remove_momentum = arguments.yes_or_no(keyword);
    else kinetic = arguments.yes_or_no(keyword);
  }
  max_rate_given = given.count("maxrate");
  take_axis(arguments, words, given);
  take_mean(lmp, arguments, words, given.count("ratio"));
  require_consistent(lmp, arguments, given.count("every"));
}

/** The form `axis y target P`, which means `y target P`. */
void PressStrainSettings::take_axis(const Arguments &errors, const Words &words, const std::set<std::string> &given) {
  const bool nothing = std::none_of(std::begin(motions), std::end(motions), [](const BoxMotion &m) { return m.given; });
  if (!given.count("axis") && !given.count("target")) {
    if (nothing && !has_mean)
      errors.fail("no motion of the box is given: use 'axis' and 'target', 'x', 'y', 'z', 'mean' or 'shear'");
    return;
  }
  if (!given.count("axis")) errors.fail("'axis x', 'axis y' or 'axis z' is required");
  if (!given.count("target")) errors.fail("'target' and a pressure are required");
  if (motions[words.axis].given)
    errors.fail(std::string("'axis ") + name_of_box_mode(words.axis) + "' and '" + name_of_box_mode(words.axis) +
                "' exclude each other");
  motions[words.axis] = {How::target, words.target, 1.0, true, "target"};
}

/** Edges without words of their own move with the mean. */
void PressStrainSettings::take_mean(LAMMPS_NS::LAMMPS *lmp, const Arguments &errors, const Words &words,
                                    bool ratio_given) {
  if (!has_mean) {
    if (ratio_given) errors.fail("'ratio' needs 'mean target' and a pressure");
    return;
  }
  double largest = 0.0;
  for (int k = 0; k < lmp->domain->dimension; k++) {
    BoxMotion &motion = motions[k];
    const std::string name = name_of_box_mode(k);
    if (motion.how == How::target)
      errors.fail("'mean' and '" + name + " target' exclude each other: hold each edge by a target of its own");
    if (motion.given) {
      if (ratio_given && words.ratios[k] != 0.0)
        errors.fail("'ratio' of " + name + " must be 0 beside '" + name + "', got " + Arguments::text(words.ratios[k]));
      continue;
    }
    if (words.ratios[k] > 0.0) motion = {How::mean, Quantity(), words.ratios[k], false, "mean target"};
    largest = std::max(largest, words.ratios[k]);
  }
  if (largest == 0.0) errors.fail("'mean' moves no edge: all are fixed, driven or have a ratio of 0");
  for (int k = 0; k < 3; k++)
    if (motions[k].how == How::mean) motions[k].ratio /= largest;
}

void PressStrainSettings::require_consistent(LAMMPS_NS::LAMMPS *lmp, const Arguments &errors, bool every_given) {
  const auto any_is = [this](How how, int begin, int end) {
    return std::any_of(motions + begin, motions + end, [how](const BoxMotion &m) { return m.how == how; });
  };
  const bool driven = any_is(How::rate, 0, number_of_box_modes), held_shear = any_is(How::target, 3, 6);
  if (every_given && every == Every::strain && !driven)
    errors.fail("'every' counts strain, and without a 'rate' the box has none: use 'every/time' or 'every/step'");
  if (!every_given)
    errors.fail(driven ? "'every', 'every/time' or 'every/step' is required"
                       : "without a 'rate', 'every/time' or 'every/step' is required");
  if (held_shear && !max_rate_given)
    errors.fail("'shear' with 'target' needs 'maxrate': grains that yield would be sheared ever faster");
  if (!control.automatic && (held_shear || has_mean))
    errors.fail(std::string("'gain' must be auto with ") + (has_mean ? "'mean'" : "'target' of a shear") + ", got " +
                Arguments::text(control.gain));
  if (sheared() && !lmp->domain->triclinic)
    errors.fail("'shear' needs a triclinic box: add 'change_box all triclinic' after the grains are in");
}

int PressStrainSettings::main_edge() const {
  for (How how : {How::target, How::mean})
    for (int k = 0; k < 3; k++)
      if (motions[k].how == how) return k;
  return -1;
}

std::vector<int> PressStrainSettings::controlled_modes(int dimension) const {
  std::vector<int> modes;
  for (int k = 0; k < number_of_box_modes; k++)
    if (motions[k].how == How::target || (has_mean && k < dimension)) modes.push_back(k);
  return modes;
}

bool PressStrainSettings::sheared() const {
  return std::any_of(motions + 3, motions + 6, [](const BoxMotion &m) { return m.given; });
}

bool PressStrainSettings::drives_an_edge() const {
  return std::any_of(motions, motions + 3, [](const BoxMotion &m) { return m.how == How::rate; });
}

bool PressStrainSettings::follows_variables() const {
  return !mean.variable.empty() || std::any_of(std::begin(motions), std::end(motions),
                                               [](const BoxMotion &m) { return !m.value.variable.empty(); });
}

double PressStrainSettings::strain_rate(const double rates[number_of_box_modes]) const {
  const auto driven = [this](int k) { return motions[k].how == How::rate; };
  double of_edges = 0.0, of_driven_shears = 0.0, of_shears = 0.0;
  for (int k = 0; k < 3; k++)
    if (driven(k)) of_edges = std::max(of_edges, std::fabs(rates[k]));
  for (int k = 3; k < 6; k++) {
    of_shears = std::hypot(of_shears, rates[k]);
    if (driven(k)) of_driven_shears = std::hypot(of_driven_shears, rates[k]);
  }
  return of_driven_shears > 0.0 ? of_driven_shears : of_edges > 0.0 ? of_edges : of_shears;
}

void PressStrainSettings::evaluate_rates(LAMMPS_NS::LAMMPS *lmp) {
  double rates[number_of_box_modes] = {}, of_shears = 0.0, of_edges = 0.0;
  for (int k = 0; k < number_of_box_modes; k++) {
    if (motions[k].how != How::rate) continue;
    Quantity &rate = motions[k].value;
    if (!rate.variable.empty()) rate.value = value_of(lmp, motions[k].word.c_str(), rate);
    if (!std::isfinite(rate.value) || (rate.value == 0.0 && k >= 3))
      press_strain_error(lmp, "'" + motions[k].word + "' must be a " + (k < 3 ? "rate" : "shear rate other than 0") +
                                  got(rate));
    if (std::fabs(rate.value) * lmp->update->dt > largest_step)
      press_strain_error(lmp, "'" + motions[k].word + "' must be below " + Arguments::text(largest_step) +
                                  " per time step" + got(rate));
    rates[k] = rate.value;
    if (k < 3) of_edges += std::fabs(rate.value);
    else of_shears = std::max(of_shears, std::fabs(rate.value));
  }
  if (every == Every::strain && strain_rate(rates) == 0.0)
    press_strain_error(lmp, "'every' counts strain, and all rates are 0");
  // If an edge is driven, another must be free to move as fast as both others at constant volume, and to dilate.
  const double fastest = std::max(of_shears, 3.0 * of_edges);
  if (!max_rate_given) control.max_rate = fastest > 0.0 ? fastest : HUGE_VAL;
}

void PressStrainSettings::evaluate_targets(LAMMPS_NS::LAMMPS *lmp) {
  const auto evaluate = [lmp](Quantity &target, const std::string &word, bool pressure) {
    if (!target.variable.empty()) target.value = value_of(lmp, word.c_str(), target);
    if (!std::isfinite(target.value) || (pressure && !(target.value >= 0.0)))
      press_strain_error(lmp,
                         "'" + word + "' must be " + (pressure ? "a pressure >= 0" : "a shear stress") + got(target));
  };
  for (int k = 0; k < number_of_box_modes; k++)
    if (motions[k].how == How::target) evaluate(motions[k].value, motions[k].word, k < 3);
  if (has_mean) evaluate(mean, "mean target", true);
}

}

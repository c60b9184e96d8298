// SPDX-License-Identifier: GPL-2.0-or-later
#include "press_wall_settings.h"
#include "arguments.h"
#include "two_dimensions.h"
#include <cmath>
#include <set>

namespace grainscope {

namespace {

const char *const target_requirement = "a pressure > 0 or a variable v_name";

bool positive(double x) { return x > 0.0; }

bool whole(double x) { return x >= 1.0 && x == std::floor(x); }

}

PressWallSettings::PressWallSettings(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg)
    : target(lmp, "fix press/wall", "target", target_requirement) {
  Arguments arguments(lmp, "fix press/wall", 3, narg, arg);
  std::set<std::string> given;
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword(
        {"mesh", "axis", "target", "area", "every/time", "every/step", "toward", "gain", "base", "limit", "maxrate"});
    if (!given.insert(keyword.compare(0, 5, "every") == 0 ? "every" : keyword).second)
      arguments.fail("'every/time' and 'every/step' exclude each other, got a second one: '" + keyword + "'");
    read(arguments, keyword);
  }
  limit_given = given.count("limit");
  max_rate_given = given.count("maxrate");
  if (!given.count("mesh")) arguments.fail("'mesh' and the ID of a fix mesh/surface are required");
  if (!given.count("axis")) arguments.fail("'axis x', 'axis y' or 'axis z' is required");
  if (!given.count("target")) arguments.fail("'target' and a pressure are required");
  if (!given.count("area")) arguments.fail("'area' and an area, or 'area box', is required");
  if (!given.count("every")) arguments.fail("'every/time' or 'every/step' is required");
}

void PressWallSettings::read(Arguments &arguments, const std::string &keyword) {
  if (keyword == "mesh") mesh = arguments.word("the ID of a fix mesh/surface");
  else if (keyword == "axis") {
    const std::string name = arguments.choice(keyword, {"x", "y", "z"});
    require_axes_of_plane(arguments.host(), arguments, keyword, "x or y", name);
    axis = name[0] - 'x';
  } else if (keyword == "target") {
    const std::string word = arguments.word(target_requirement);
    target.set(arguments, word);
    target_varies = word.compare(0, 2, "v_") == 0;
  } else if (keyword == "area") {
    const std::string requirement = "box or an area > 0", word = arguments.word(requirement);
    if (word != "box" && (!Arguments::is_number(word, area) || area <= 0.0)) arguments.fail("area", requirement, word);
  } else if (keyword == "every/time") {
    every = Every::time;
    interval = arguments.number(keyword, "a time > 0", positive);
  } else if (keyword == "every/step") interval = arguments.number(keyword, "a whole number of steps >= 1", whole);
  else if (keyword == "toward") toward = arguments.choice(keyword, {"+", "-"}) == "+" ? 1.0 : -1.0;
  else if (keyword == "gain") {
    const std::string requirement = "auto or a velocity per pressure >= 0", word = arguments.word(requirement);
    control.automatic = word == "auto";
    if (!control.automatic && (!Arguments::is_number(word, control.gain) || control.gain < 0.0))
      arguments.fail("gain", requirement, word);
  } else if (keyword == "base") base = arguments.yes_or_no(keyword);
  else if (keyword == "limit") control.limit = arguments.number(keyword, "a distance > 0", positive);
  else control.max_rate = arguments.number(keyword, "a velocity > 0", positive);
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "press_strain_host_arguments.h"
#include "sheared_box.h"
#include "domain.h"
#include "lammps.h"
#include <algorithm>

namespace grainscope {

PressStrainHostArguments::PressStrainHostArguments(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg)
    : words_{arg[0], arg[1], "deform", "1"} {
  const LAMMPS_NS::Domain *domain = lmp->domain;
  const std::vector<std::string> given(arg + std::min(narg, 3), arg + narg);
  const auto has = [&given](const std::string &word) {
    return std::find(given.begin(), given.end(), word) != given.end();
  };
  // What LIGGGHTS would refuse is refused later, with our own message.
  const auto shrinks = [domain](int edge) { return domain->boundary[edge][0] >= 2 || domain->boundary[edge][1] >= 2; };
  for (int edge = 0; edge < domain->dimension; edge++)
    if ((has(std::string(1, "xyz"[edge])) || has("mean")) && !shrinks(edge)) move(std::string(1, "xyz"[edge]));
  for (const Tilt &tilt : tilts)
    if (has(tilt.name) && domain->triclinic && !shrinks(tilt.gradient)) move(tilt.name);
  words_.insert(words_.end(), {"remap", "v", "units", "box"});
  for (std::string &word : words_) pointers_.push_back(&word[0]);
}

void PressStrainHostArguments::move(const std::string &parameter) {
  words_.insert(words_.end(), {parameter, "vel", "0"});
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "press_strain_host_arguments.h"
#include "sheared_box.h"
#include "domain.h"
#include "lammps.h"
#include <cstring>

namespace grainscope {

PressStrainHostArguments::PressStrainHostArguments(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg)
    : words_{arg[0], arg[1], "deform", "1"} {
  const LAMMPS_NS::Domain *domain = lmp->domain;
  std::string axis = "y", shear;
  for (int k = 3; k + 1 < narg; k++) {
    if (!strcmp(arg[k], "axis") && strlen(arg[k + 1]) == 1 && strchr("xyz", arg[k + 1][0])) axis = arg[k + 1];
    for (const Tilt &tilt : tilts)
      if (!strcmp(arg[k], "shear") && !strcmp(arg[k + 1], tilt.name) && domain->triclinic &&
          domain->boundary[tilt.gradient][0] < 2 && domain->boundary[tilt.gradient][1] < 2)
        shear = tilt.name;
  }
  const int *boundary = domain->boundary[axis[0] - 'x'];
  if (boundary[0] >= 2 || boundary[1] >= 2) axis.clear();  // refused in our own words, later
  for (const std::string &one : {axis, shear})
    if (!one.empty()) words_.insert(words_.end(), {one, "vel", "0"});
  words_.insert(words_.end(), {"remap", "v", "units", "box"});
  for (std::string &word : words_) pointers_.push_back(&word[0]);
}

}

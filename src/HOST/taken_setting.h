// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_TAKEN_SETTING_H
#define GRAINSCOPE_TAKEN_SETTING_H

#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace grainscope {

/** Takes `keyword no|yes` out of the words of a command, which are otherwise the host's; whether it was yes. `who`: the
 *  command, for errors. */
bool take_setting(LAMMPS_NS::LAMMPS *lmp, const std::string &who, std::vector<char *> &words, const char *keyword,
                  const char *no, const char *yes);

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_RESTART_DATA_H
#define GRAINSCOPE_RESTART_DATA_H

#include "modify.h"
#include <cstring>
#include <string>
#include <vector>

namespace grainscope {

/** What a restart file holds for fixes, until the first run begins; protected in LIGGGHTS. */
struct RestartData : LAMMPS_NS::Modify {
  struct Entry {
    std::string id, style;
    const char *state;
  };

  static std::vector<Entry> all(Modify *modify) {
    std::vector<Entry> found;
    for (int k = 0; k < modify->*(&RestartData::nfix_restart_global); k++)
      found.push_back({(modify->*(&RestartData::id_restart_global))[k],
                       (modify->*(&RestartData::style_restart_global))[k],
                       (modify->*(&RestartData::state_restart_global))[k]});
    return found;
  }

  /** Of a fix, or null. */
  static const char *of(Modify *modify, const std::string &id) {
    for (const Entry &entry : all(modify))
      if (entry.id == id) return entry.state;
    return nullptr;
  }

  /** The number that states of LIGGGHTS begin with: how many it holds for each contact or grain. */
  static double first_number(const char *state) {
    double number;
    memcpy(&number, state, sizeof number);
    return number;
  }
};

}

#endif

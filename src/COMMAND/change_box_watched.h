// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMMAND_CLASS

CommandStyle(change_box,ChangeBoxWatched)

#else

#ifndef LMP_CHANGE_BOX_WATCHED_H
#define LMP_CHANGE_BOX_WATCHED_H

#include "pointers.h"

namespace LAMMPS_NS {

/** The command change_box of LIGGGHTS; computes that follow grains in the box are called before and after it. */
class ChangeBoxWatched : protected Pointers {
 public:
  explicit ChangeBoxWatched(class LAMMPS *lmp) : Pointers(lmp) {}
  void command(int narg, char **arg);
};

}

#endif
#endif

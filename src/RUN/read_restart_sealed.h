// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMMAND_CLASS

CommandStyle(read_restart,ReadRestartSealed)

#else

#ifndef LMP_READ_RESTART_SEALED_H
#define LMP_READ_RESTART_SEALED_H

#include "pointers.h"

namespace LAMMPS_NS {

/** The command read_restart of LIGGGHTS, which does not check what it reads, behind a check that the file is whole; of
 *  several files it reads the newest that is whole. See doc/read_restart.md. */
class ReadRestartSealed : protected Pointers {
 public:
  explicit ReadRestartSealed(class LAMMPS *lmp) : Pointers(lmp) {}
  void command(int narg, char **arg);
};

}

#endif
#endif

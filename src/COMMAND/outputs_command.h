// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMMAND_CLASS

CommandStyle(outputs,OutputsCommand)

#else

#ifndef LMP_OUTPUTS_COMMAND_H
#define LMP_OUTPUTS_COMMAND_H

#include "pointers.h"

namespace LAMMPS_NS {

/** `outputs ID [prefix p]`: prints what a compute or fix gives, with names, and defines an equal-style variable for
 *  each number of its scalar and vector, so that the input script reads v_ID_name in place of c_ID[k]. See
 *  doc/outputs.md. */
class OutputsCommand : protected Pointers {
 public:
  explicit OutputsCommand(class LAMMPS *lmp) : Pointers(lmp) {}
  void command(int narg, char **arg);
};

}

#endif
#endif

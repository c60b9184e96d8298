// SPDX-License-Identifier: GPL-2.0-or-later
#include "arguments.h"
#include "error.h"
#include "lammps.h"
#include <cstdlib>

namespace grainscope {

void end_run(LAMMPS_NS::LAMMPS *lmp, const std::string &message) {
  lmp->error->all(FLERR, message.c_str());
  std::abort();  // not reached: error->all ends the run
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "chosen_axis.h"
#include "arguments.h"
#include "comm.h"
#include "error.h"
#include "lammps.h"

namespace grainscope {

void MixtureWarning::warn(LAMMPS_NS::LAMMPS *lmp, const std::string &style, const std::string &group, double flat,
                          double all) {
  if (warned_ || flat == 0.0 || flat == all) return;
  warned_ = true;
  if (lmp->comm->me != 0) return;
  lmp->error->warning(
      FLERR, (style + ": group '" + group + "' mixes flat and long grains (" + Arguments::text(flat) + " and " +
              Arguments::text(all - flat) +
              "): the symmetry axis of a flat grain is its shortest, that of a long grain its longest. Use 'axis "
              "short' or 'axis long' to measure one kind, or 'axis symmetry' to keep both together")
                 .c_str());
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_REQUIRE_FINITE_H
#define GRAINSCOPE_REQUIRE_FINITE_H

#include "arguments.h"
#include "lammps.h"
#include "update.h"

namespace grainscope {

/** Ends the run unless `count`, a number over all ranks, is 0. The message gives the step, `what`, the count and `of`:
 *  `what` "the positions", `of` "grains are not finite: check what moves them". */
inline void require_finite(LAMMPS_NS::LAMMPS *lmp, const std::string &who, double count, const std::string &what,
                           const std::string &of) {
  if (count == 0.0) return;
  Arguments(lmp, who).fail("step " + std::to_string(lmp->update->ntimestep) + ": " + what + " of " +
                           Arguments::text(count) + " " + of);
}

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_LAST_RUN_H
#define GRAINSCOPE_LAST_RUN_H

#include "host_box.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace grainscope {

class GrainMemory;

/** The state of the last run at its end, besides its grains: the next run may continue it only if none of it has
 *  changed. Doubles only, as in restart files. */
struct LastRun {
  HostBox box;
  double grains = -1.0;  // -1 before the first run
  double time_step = 0.0;
  double steps_to_sorting = 0.0;  // until the host sorts grains by position
  double moving_fixes = 0.0;      // checksum of the fixes that push or move grains

  static LastRun ending_now(LAMMPS_NS::LAMMPS *lmp);
  bool there_was_none() const { return grains < 0.0; }
  /** Whether all of it, and every grain, is unchanged; prints a note if not. Collective. */
  bool goes_on(LAMMPS_NS::LAMMPS *lmp, const GrainMemory &memory) const;

 private:
  bool same_box(const LAMMPS_NS::LAMMPS *lmp) const;
};

}

#endif

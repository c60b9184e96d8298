// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PRESS_STRAIN_REQUIREMENTS_H
#define GRAINSCOPE_PRESS_STRAIN_REQUIREMENTS_H

#include "pointers.h"

namespace LAMMPS_NS {
class Fix;
}

namespace grainscope {

struct PressStrainSettings;
class ShearedBox;
struct Tilt;

/** What fix press/strain requires of the box and of other fixes. A requirement that is not met ends the run. Checked in
 *  the constructor and before each run. */
class PressStrainRequirements : private LAMMPS_NS::Pointers {
 public:
  /** `fix`: press/strain itself. */
  PressStrainRequirements(LAMMPS_NS::LAMMPS *lmp, const LAMMPS_NS::Fix *fix, const PressStrainSettings &settings)
      : Pointers(lmp), fix_(fix), settings_(settings) {}

  void require_controllable_box(const ShearedBox &box) const;
  /** The host lets a group be deleted that no fix is registered for, and this fix is for `all`. */
  void require_group(const char *name, int groupbit) const;
  /** The normal models of grains and walls, where they decide the gain; when all of them are initialised. */
  void require_known_stiffness() const;

 private:
  const LAMMPS_NS::Fix *fix_;
  const PressStrainSettings &settings_;

  void require_alone() const;
  void require_no_wall_on_axis(LAMMPS_NS::Fix *wall, int edge) const;
  bool takes_part(const Tilt &tilt) const;
};

}

#endif

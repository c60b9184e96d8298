// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PRESS_WALL_REQUIREMENTS_H
#define GRAINSCOPE_PRESS_WALL_REQUIREMENTS_H

#include "pointers.h"

namespace grainscope {

class PressedMesh;
struct PressWallSettings;

/** What fix press/wall requires of the box, the walls and the grains. A requirement that is not met ends the run. */
class PressWallRequirements : private LAMMPS_NS::Pointers {
 public:
  PressWallRequirements(LAMMPS_NS::LAMMPS *lmp, const PressWallSettings &settings, const PressedMesh &mesh)
      : Pointers(lmp), settings_(settings), mesh_(mesh) {}

  /** The area of the box has no meaning if its faces are shrink-wrapped or lean. */
  void require_area() const;
  /** A warning, once, if the plate, or the part of it between other walls, is smaller than the cross-section of the box
   *  by which `area box` divides. Collective. */
  void warn_of_smaller_plate();
  /** The normal models of walls, where they decide the gain; when all of them are initialised. */
  void require_known_stiffness() const;
  /** The side of the plate on which the grains of the group are, 1 or -1 along the axis: the plate is pushed toward it.
   *  `toward`: the given side, or 0. Collective. */
  double side_of_grains(double toward, int groupbit) const;
  /** Errors unless neighbour lists keep up with the plate, and its limit is known. `interval`: the time between two
   *  inputs. */
  void require_slow_plate(double interval) const;

 private:
  const PressWallSettings &settings_;
  const PressedMesh &mesh_;
  bool warned_ = false;
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PRESS_WALL_REQUIREMENTS_H
#define GRAINSCOPE_PRESS_WALL_REQUIREMENTS_H

#include "pointers.h"

namespace grainscope {

class PressedMesh;
struct PressWallSettings;

/** What fix press/wall needs of the box, the walls and the grains: what is not met ends the run. */
class PressWallRequirements : private LAMMPS_NS::Pointers {
 public:
  PressWallRequirements(LAMMPS_NS::LAMMPS *lmp, const PressWallSettings &settings, const PressedMesh &mesh)
      : Pointers(lmp), settings_(settings), mesh_(mesh) {}

  /** That of the box has no meaning where its faces follow the grains or lean. */
  void require_area() const;
  /** The normal models of walls, where they decide the gain; when all of them are initialised. */
  void require_known_stiffness() const;
  /** Which side of the plate those of a group are on, 1 or -1 along the axis: it is pushed toward them. `toward`: what
   *  is known of it, or 0. Collective. */
  double side_of_grains(double toward, int groupbit) const;
  /** That neighbour lists keep up with it, and that its limit is known. `interval`: the time between two inputs. */
  void require_slow_plate(double interval) const;

 private:
  const PressWallSettings &settings_;
  const PressedMesh &mesh_;
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PACKED_SCENE_H
#define GRAINSCOPE_PACKED_SCENE_H

#include "ellipsoid_bodies.h"
#include "pair_group.h"
#include "atom.h"
#include "pointers.h"
#include <algorithm>
#include <vector>

namespace grainscope {

/** All owned and ghost grains as the pair loop reads them, and the forces that it adds up. */
class PackedScene : private LAMMPS_NS::Pointers {
 public:
  explicit PackedScene(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  /** With a new neighbour list, for ellipsoids: what stays until the next. */
  void restart(const EllipsoidBodies &bodies);
  /** With every force evaluation: where the grains are and how they move, of all, or of `many` from the first of them
   *  on. `bodies`: null for spheres that are no ellipsoids. */
  void load(const EllipsoidBodies *bodies, int first, int many);
  void load_spheres();
  /** And the forces on them so far. */
  void load_forces();
  void hand_back_forces() const;

  PackedGrains grains() { return {grains_.data(), shapes_.data(), shapes_.size() == 1, forces_.data(), atom->nlocal}; }
  const PackedGrain *packed() const { return grains_.data(); }
  /** On one of them; of ghosts all in one place, which nobody reads. */
  PackedForce &force_on(int grain) { return forces_[std::min<std::size_t>(grain, forces_.size() - 1)]; }

 private:
  std::vector<PackedGrain> grains_;
  std::vector<PackedShape> shapes_;  // one, if it is that of all
  std::vector<unsigned char> symmetry_;
  std::vector<PackedForce> forces_;
};

}

#endif

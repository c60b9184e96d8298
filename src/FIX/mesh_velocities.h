// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_MESH_VELOCITIES_H
#define GRAINSCOPE_MESH_VELOCITIES_H

#include "pointers.h"
#include <vector>

namespace LAMMPS_NS {
class TriMesh;
}

namespace grainscope {

/** The velocities of the moving meshes of a wall in the last force evaluation. LIGGGHTS sets them to zero when a run
 *  begins, even if the meshes move. Every rank keeps the velocities of all triangles. */
class MeshVelocities : private LAMMPS_NS::Pointers {
 public:
  explicit MeshVelocities(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  /** Forgets what was kept and keeps those of `meshes`. Collective. */
  void keep(const std::vector<LAMMPS_NS::TriMesh *> &meshes);
  /** Gives them back to the triangles that are on this rank now, ghosts included; those that had none get zero. Same
   *  meshes in the same order. */
  void restore(const std::vector<LAMMPS_NS::TriMesh *> &meshes) const;

  /** In restart files: `width` numbers for each triangle. */
  static constexpr int width = 11;  // number of the mesh, ID of the triangle, velocities of its three nodes
  const std::vector<double> &numbers() const { return numbers_; }
  bool empty() const { return numbers_.empty(); }
  void set_numbers(const double *numbers, std::size_t n) { numbers_.assign(numbers, numbers + n); }

 private:
  std::vector<double> numbers_;
};

}

#endif

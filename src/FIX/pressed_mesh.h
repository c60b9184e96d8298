// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PRESSED_MESH_H
#define GRAINSCOPE_PRESSED_MESH_H

#include "pointers.h"
#include <string>
#include <vector>

namespace LAMMPS_NS {
class FixMeshSurface;
class FixMoveMesh;
class TriMesh;
}

namespace grainscope {

/** The mesh that fix press/wall moves along an axis as a whole: its requirements, position and velocity. */
class PressedMesh : private LAMMPS_NS::Pointers {
 public:
  PressedMesh(LAMMPS_NS::LAMMPS *lmp, std::string name, int axis)
      : Pointers(lmp), name_(std::move(name)), axis_(axis) {}

  /** Finds it; errors unless it is a mesh of a fix wall/gran in a box that is not periodic along the axis, and nobody
   *  but `mover` moves it (before that is there: null). Collective. */
  void find(const LAMMPS_NS::FixMoveMesh *mover);
  const std::string &name() const { return name_; }
  /** Whether a contact with this wall, by PartnerWall::wall, is one with the mesh. */
  bool has(int wall) const { return is_mesh_[wall]; }

  /** Gives its nodes the velocities that contacts use. */
  void keep_velocities() const;
  void set_velocity(double velocity) const;

  /** Finds where it is. Collective. */
  void locate();
  /** Its lowest and highest node along the axis. */
  double low() const { return low_; }
  double high() const { return high_; }
  /** By a distance along the axis, in the name of `mover`; an error where it would leave a box that does not follow. */
  void move(double distance, LAMMPS_NS::FixMoveMesh *mover);

 private:
  std::string name_;
  int axis_;
  LAMMPS_NS::FixMeshSurface *mesh_ = nullptr;
  std::vector<bool> is_mesh_;
  double low_ = 0.0, high_ = 0.0;

  void require_alone(const LAMMPS_NS::FixMoveMesh *mover) const;
};

}

#endif

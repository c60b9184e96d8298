// SPDX-License-Identifier: GPL-2.0-or-later
#include "pressed_mesh.h"
#include "arguments.h"
#include "fix_wall_gran_insitu.h"
#include "nearest_name.h"
#include "domain.h"
#include "fix_mesh_surface.h"
#include "fix_move_mesh.h"
#include "modify.h"
#include "tri_mesh.h"
#include <algorithm>
#include <limits>

namespace grainscope {

using LAMMPS_NS::FixMoveMesh;
using LAMMPS_NS::MultiVectorContainer;
using LAMMPS_NS::TriMesh;

namespace {

using Velocities = MultiVectorContainer<double, 3, 3>;  // of each triangle and node

const int face_that_stands = 1;  // of the host's numbers for p f s m

}

void PressedMesh::find(const FixMoveMesh *mover) {
  const Arguments errors(lmp, "fix press/wall");
  std::vector<std::string> names;
  is_mesh_.clear();
  mesh_ = nullptr;
  for (const Wall &wall : walls_of(lmp)) {
    is_mesh_.push_back(wall.mesh && wall.name == name_);
    if (is_mesh_.back()) mesh_ = wall.mesh;
    if (wall.mesh) names.push_back(wall.name);
  }
  if (!mesh_) {
    std::string list;
    for (const std::string &name : names) list += (list.empty() ? "" : ", ") + name;
    errors.fail("'mesh' must name a mesh of a fix wall/gran, got '" + name_ +
                "': " + (list.empty() ? "there are none yet, define it after fix wall/gran" : "there are " + list) +
                nearest_name(name_, names));
  }
  require_alone(mover);
  if (domain->periodicity[axis_])
    errors.fail(std::string("the box must not be periodic along 'axis ") + "xyz"[axis_] +
                "', because grains would be on both sides of the plate");
}

void PressedMesh::require_alone(const FixMoveMesh *mover) const {
  const Arguments errors(lmp, "fix press/wall");
  const std::string mesh = "mesh '" + name_ + "' ";
  if (mesh_->triMesh()->isDeforming()) errors.fail(mesh + "deforms, but a plate must be rigid");
  if (mesh_->surfaceVel())
    errors.fail(mesh + "has the surface velocity of a conveyor belt, but a plate must have the velocity of its motion");
  for (int k = 0; k < modify->nfix; k++) {
    const FixMoveMesh *const other = dynamic_cast<FixMoveMesh *>(modify->fix[k]);
    if (other && other != mover && other->fixMeshCompare(mesh_))
      errors.fail(mesh + "is moved by fix " + other->id + " too: remove one of them");
  }
  if (mesh_->mesh()->nMove() != (mover ? 1 : 0))
    errors.fail(mesh + "moves by itself (" + mesh_->style + "): use a fix mesh/surface or mesh/surface/stress");
}

void PressedMesh::keep_velocities() const {
  auto &properties = mesh_->mesh()->prop();
  if (!properties.getElementProperty<Velocities>("v"))
    properties.addElementProperty<Velocities>("v", "comm_exchange_borders", "frame_invariant", "restart_no");
}

void PressedMesh::set_velocity(double velocity) const {
  double ***const v = mesh_->mesh()->prop().getElementProperty<Velocities>("v")->begin();
  const int triangles = mesh_->mesh()->size();
  for (int i = 0; i < triangles; i++)
    for (int node = 0; node < 3; node++)
      for (int k = 0; k < 3; k++) v[i][node][k] = k == axis_ ? velocity : 0.0;
}

void PressedMesh::locate() {
  constexpr double far = std::numeric_limits<double>::infinity();
  double ends[2] = {-far, -far};  // minus the lowest, the highest
  TriMesh &mesh = *mesh_->triMesh();
  for (int i = 0; i < mesh.sizeLocal(); i++)
    for (int k = 0; k < 3; k++) {
      double node[3];
      mesh.node(i, k, node);
      ends[0] = std::max(ends[0], -node[axis_]);
      ends[1] = std::max(ends[1], node[axis_]);
    }
  MPI_Allreduce(MPI_IN_PLACE, ends, 2, MPI_DOUBLE, MPI_MAX, world);
  low_ = -ends[0];
  high_ = ends[1];
}

void PressedMesh::move(double distance, FixMoveMesh *mover) {
  const int *const faces = domain->boundary[axis_];
  const bool below = faces[0] == face_that_stands && low_ + distance < domain->boxlo[axis_];
  const bool above = faces[1] == face_that_stands && high_ + distance > domain->boxhi[axis_];
  if (below || above)
    Arguments(lmp, "fix press/wall")
        .fail("mesh '" + name_ + "' would leave the box, at " + "xyz"[axis_] + " = " +
              Arguments::text(below ? low_ + distance : high_ + distance) + " beyond " +
              Arguments::text(below ? domain->boxlo[axis_] : domain->boxhi[axis_]) +
              ": make the box longer, or use 'boundary m'");
  double step[3] = {0.0, 0.0, 0.0};
  step[axis_] = distance;
  mesh_->move(step, mover);
  // as each node was moved, to the last bit
  low_ += distance;
  high_ += distance;
}

}

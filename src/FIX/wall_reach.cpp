// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_reach.h"
#include "fix_mesh_surface.h"
#include "lammps.h"
#include "tri_mesh.h"
#include <algorithm>
#include <limits>

namespace grainscope {

namespace {

constexpr double far = std::numeric_limits<double>::infinity();

}

bool is_plane(const std::vector<std::string> &primitive) {
  return primitive[0].compare(1, std::string::npos, "plane") == 0;
}

WallReach WallReach::of(const Wall &wall, MPI_Comm world) {
  if (!wall.mesh) {
    WallReach found{{-far, -far, -far}, {far, far, far}};
    const int axis = wall.primitive[0][0] - 'x', u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto number = [&wall](int k) { return std::stod(wall.primitive[k]); };
    if (is_plane(wall.primitive)) found.low[axis] = found.high[axis] = number(1);
    for (int k = 2; k <= 3 && !is_plane(wall.primitive); k++) {
      found.low[k == 2 ? u : v] = number(k) - number(1);
      found.high[k == 2 ? u : v] = number(k) + number(1);
    }
    return found;
  }
  double ends[6] = {-far, -far, -far, -far, -far, -far};  // minus the lowest, the highest
  LAMMPS_NS::TriMesh &mesh = *wall.mesh->triMesh();
  for (int i = 0; i < mesh.sizeLocal(); i++)
    for (int n = 0; n < 3; n++) {
      double node[3];
      mesh.node(i, n, node);
      for (int k = 0; k < 3; k++) {
        ends[k] = std::max(ends[k], -node[k]);
        ends[3 + k] = std::max(ends[3 + k], node[k]);
      }
    }
  MPI_Allreduce(MPI_IN_PLACE, ends, 6, MPI_DOUBLE, MPI_MAX, world);
  return {{-ends[0], -ends[1], -ends[2]}, {ends[3], ends[4], ends[5]}};
}

WallReach WallReach::in(const BoxState &box) const {
  WallReach part;
  for (int k = 0; k < 3; k++) {
    const double middle = box.cell_centre[k], half = 0.5 * box.edges(k, k);
    part.low[k] = std::max(low[k], middle - half);
    part.high[k] = std::min(high[k], middle + half);
  }
  return part;
}

std::string walls_that_bound(const Wall &wall, const BoxState &box, LAMMPS_NS::LAMMPS *lmp) {
  const bool flat = wall.mesh || is_plane(wall.primitive);
  const WallReach own = WallReach::of(wall, lmp->world).in(box);
  const double rounding = 1e-9 * box.edges.diagonal().maxCoeff();
  std::string names;
  for (const Wall &other : walls_of(lmp)) {
    if (other.name == wall.name || (!flat && (other.mesh || !is_plane(other.primitive)))) continue;
    const WallReach its = WallReach::of(other, lmp->world);
    bool meet = true, ends = false;
    for (int k = 0; k < box.dimension; k++) {
      meet = meet && its.low[k] <= own.high[k] + rounding && its.high[k] >= own.low[k] - rounding;
      for (double end : {its.low[k], its.high[k]})
        ends = ends || (end > own.low[k] + rounding && end < own.high[k] - rounding);
    }
    if (meet && ends) names += (names.empty() ? "" : ", ") + other.name;
  }
  return names;
}

}

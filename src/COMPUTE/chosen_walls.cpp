// SPDX-License-Identifier: GPL-2.0-or-later
#include "chosen_walls.h"
#include "arguments.h"
#include "box_state.h"
#include "nearest_name.h"
#include "wall_reach.h"
#include "fix_mesh_surface.h"
#include "tri_mesh.h"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace grainscope {

namespace {

bool has(const std::vector<std::string> &names, const std::string &name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string listed(const std::vector<std::string> &names) {
  std::string list;
  for (const std::string &name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

/** The edge has no other component than that along its axis. */
bool along_axis(const Eigen::Matrix3d &edges, int k) {
  return edges((k + 1) % 3, k) == 0.0 && edges((k + 2) % 3, k) == 0.0;
}

}

ChosenWalls::ChosenWalls(LAMMPS_NS::LAMMPS *lmp, const Arguments &errors, Kind kind,
                         const std::vector<std::string> &named)
    : lmp_(lmp), kind_(kind), all_(named.empty()) {
  if (all_) names_ = names_that_there_are();
  for (const std::string &name : named) {
    if (has(names_, name)) errors.fail("'walls' names '" + name + "' twice");
    require_known(name, "walls", errors);
    names_.push_back(name);
  }
}

std::vector<std::string> ChosenWalls::names_that_there_are() const {
  std::vector<std::string> names;
  for (const Wall &wall : walls_of(lmp_))
    if (kind_ == Kind::any || wall.mesh) names.push_back(wall.name);
  return names;
}

std::string ChosenWalls::there_are() const {
  const std::vector<std::string> names = names_that_there_are();
  if (names.empty()) return "there are none yet, define it after fix wall/gran";
  return "there are " + listed(names);
}

void ChosenWalls::require_known(const std::string &name, const std::string &keyword, const Arguments &errors) const {
  const std::vector<std::string> names = names_that_there_are();
  if (has(names, name)) return;
  const std::string what =
      kind_ == Kind::any ? "walls (a fix wall/gran primitive, or a mesh of one)" : "meshes of a fix wall/gran";
  errors.fail("'" + keyword + "' must name " + what + ", got '" + name + "': " + there_are() +
              nearest_name(name, names));
}

int ChosenWalls::index_of(const std::string &name, const std::string &keyword, const Arguments &errors) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) {
    require_known(name, keyword, errors);
    errors.fail("'" + keyword + "' names '" + name + "', which is not one of the chosen walls");
  }
  return static_cast<int>(found - names_.begin());
}

std::vector<int> ChosenWalls::find(const Arguments &errors) {
  const std::vector<Wall> walls = walls_of(lmp_);
  std::vector<int> place;
  walls_.assign(names_.size(), Wall());
  for (const Wall &wall : walls) {
    const auto found = std::find(names_.begin(), names_.end(), wall.name);
    place.push_back(found == names_.end() ? -1 : static_cast<int>(found - names_.begin()));
    if (place.back() >= 0) walls_[place.back()] = wall;
  }
  const std::vector<std::string> there = names_that_there_are();
  for (const std::string &name : names_)
    if (!has(there, name))
      errors.fail("wall '" + name + "' no longer exists: " + there_are() + ". Define the compute again");
  for (const std::string &name : there)
    if (all_ && !has(names_, name))
      errors.fail(
          "wall '" + name +
          "' was defined after the compute, which measures all walls: define the compute again, or name its walls");
  return place;
}

double primitive_area(const std::vector<std::string> &wall, const BoxState &box, const std::array<bool, 3> &fixed,
                      std::string &why) {
  const int axis = wall[0][0] - 'x', u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto unknown = [&why](const char *reason) {
    why = reason;
    return 0.0;
  };
  if (is_plane(wall)) {
    if (!fixed[u] || !fixed[v]) return unknown("the box is shrink-wrapped along it, boundary s or m");
    if (box.edges(axis, u) != 0.0 || box.edges(axis, v) != 0.0)
      return unknown("it is not parallel to a face of the box");
    return box.edges.col(u).cross(box.edges.col(v)).norm();
  }
  if (!fixed[axis]) return unknown("the box is shrink-wrapped along its axis, boundary s or m");
  if (!along_axis(box.edges, axis)) return unknown("its axis is not along an edge of the box");
  const double radius = std::stod(wall[1]);
  Eigen::Vector3d middle = box.cell_centre;
  middle[u] = std::stod(wall[2]);
  middle[v] = std::stod(wall[3]);
  for (int k : {u, v}) {
    const double inside = box.fraction(middle)[k] * box.height(k), room = std::min(inside, box.height(k) - inside);
    if (fixed[k] && room < radius * (1.0 - 1e-9)) return unknown("it reaches beyond the box");
  }
  return 2.0 * M_PI * radius * box.edges(axis, axis);
}

double mesh_area(const Wall &wall) {
  LAMMPS_NS::TriMesh &mesh = *wall.mesh->triMesh();
  double area = 0.0;
  for (int k = 0; k < mesh.sizeLocal(); k++) area += mesh.areaElem(k);
  return area;
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_wall_triangle.h"
#include "arguments.h"
#include "chosen_walls.h"
#include "contact_law.h"
#include "contact_observer.h"
#include "contact_sums.h"
#include "wall_triangle_sums.h"
#include "domain.h"
#include "fix_mesh_surface.h"
#include "tri_mesh.h"
#include "update.h"
#include <algorithm>

using namespace LAMMPS_NS;
using grainscope::Arguments;
using grainscope::ChosenWalls;
using grainscope::WallTriangleSums;

namespace {

const std::vector<std::string> keywords = {"walls", "wear"};

grainscope::Outputs declared(bool wear) {
  const auto intensive = grainscope::Extent::intensive, whole = grainscope::Extent::whole;
  grainscope::Outputs outputs;
  outputs.local.add({"wall", "-", intensive, "which of the walls, from 1 in their order"})
      .add({"triangle", "-", intensive, "ID of the triangle in its mesh, from 0 as in LIGGGHTS"})
      .add_each("x y z", {"centre_*", "distance", intensive, "centre of the triangle, *"})
      .add_each("x y z", {"normal_*", "-", intensive, "unit normal of the triangle, *"})
      .add({"area", "distance^2", intensive, "area of the triangle"})
      .add({"N", "-", whole, "contacts"})
      .add({"p", "pressure", intensive, "sum of normal forces over the area"})
      .add({"P_t", "energy/time/distance^2", intensive, "power lost by friction over the area"})
      .add({"wear_rate", "pressure*velocity", intensive, "sum of F_n |u_t| of sliding contacts over the area"});
  if (wear)
    outputs.local.add(
        {"wear", "pressure*distance", intensive, "its integral over the time since the compute was defined"});
  return outputs;
}

}

struct ComputeWallTriangle::Impl {
  std::unique_ptr<ChosenWalls> walls;
  std::vector<int> place_of_wall, triangles;
  grainscope::ContactSums<WallTriangleSums> sums;
  bool keeps_wear = false;
  // of the contacts of this rank, triangle by triangle: sum of F_n |u_t| dt
  std::vector<double> wear;
  std::vector<double> values;  // the rows, one after the other
  std::vector<double *> rows;
  bool told = false;  // of the last evaluation; after a run its meshes may be gone

  /** In the first evaluation of a run, because the IDs are known when a mesh is distributed. The wear is kept, unless
   *  there are other triangles. */
  void count_triangles() {
    if (!triangles.empty()) return;
    for (const grainscope::Wall &wall : walls->walls()) triangles.push_back(wall.mesh->triMesh()->tag_max() + 1);
    sums.mine().set_meshes(place_of_wall, triangles);
    const std::size_t kept = keeps_wear ? sums.mine().triangles() : 0;
    if (wear.size() != kept) wear.assign(kept, 0.0);
  }
};

ComputeWallTriangle::ComputeWallTriangle(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : ContactCompute(lmp, iarg, narg, arg, 0, grainscope::Walls::only), impl_(new Impl) {
  Arguments arguments(lmp, name_, iarg, narg, arg);
  std::vector<std::string> named;
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword(keywords);
    if (keyword == "walls") named = arguments.words_before(keywords, "names of meshes");
    else impl_->keeps_wear = arguments.yes_or_no(keyword);
  }
  if (domain->dimension == 2)
    arguments.fail("needs three dimensions, got 'dimension 2': triangles have no areas there. compute wall/contact "
                   "has the forces of a mesh");
  impl_->walls.reset(new ChosenWalls(lmp, arguments, ChosenWalls::Kind::mesh, named));
  sums_over(impl_->sums);
  declare(this, declared(impl_->keeps_wear));
}

ComputeWallTriangle::~ComputeWallTriangle() {}

void ComputeWallTriangle::init() {
  ContactCompute::init();
  impl_->triangles.clear();
  impl_->place_of_wall = impl_->walls->find(Arguments(lmp, name_ + " " + id));
  for (const grainscope::Wall &wall : impl_->walls->walls())
    if (wall.law && !wall.law->knows_sliding())
      Arguments(lmp, name_).fail("wall '" + wall.name + "': " + wall.law->why_no_losses());
}

bool ComputeWallTriangle::wants_contacts() { return ContactCompute::wants_contacts() || impl_->keeps_wear; }

void ComputeWallTriangle::begin_contacts() {
  impl_->told = false;
  impl_->count_triangles();
  ContactCompute::begin_contacts();
}

/** The first evaluation of a run is at a time that was counted before, or in no step. */
void ComputeWallTriangle::end_contacts() {
  if (!observer_->springs_move()) return;
  for (std::size_t k = 0; k < impl_->wear.size(); k++)
    impl_->wear[k] += impl_->sums.mine().at(k)[WallTriangleSums::archard] * observer_->time_step();
}

/** Each rank writes the triangles that it owns. */
void ComputeWallTriangle::compute_local() {
  require_tally();
  invoked_local = update->ntimestep;
  if (impl_->told) return;
  impl_->told = true;
  const WallTriangleSums &all = impl_->sums.total(*this);
  std::vector<double> wear = impl_->wear;
  sum_over_ranks(wear.data(), static_cast<int>(wear.size()));
  std::vector<double> &values = impl_->values;
  values.clear();
  for (int wall = 0; wall < impl_->walls->size(); wall++) {
    TriMesh &mesh = *impl_->walls->walls()[wall].mesh->triMesh();
    for (int k = 0; k < mesh.sizeLocal(); k++) {
      const std::size_t place = all.place(wall, mesh.id(k));
      const double *const sums = all.at(place), area = mesh.areaElem(k);
      double centre[3], normal[3];
      mesh.center(k, centre);
      mesh.surfaceNorm(k, normal);
      values.insert(values.end(), {wall + 1.0, static_cast<double>(mesh.id(k))});
      values.insert(values.end(), centre, centre + 3);
      values.insert(values.end(), normal, normal + 3);
      values.insert(values.end(), {area, sums[WallTriangleSums::contacts], sums[WallTriangleSums::normal] / area,
                                   sums[WallTriangleSums::friction] / area, sums[WallTriangleSums::archard] / area});
      if (impl_->keeps_wear) values.push_back(wear[place] / area);
    }
  }
  const std::size_t width = outputs().local.size();
  size_local_rows = static_cast<int>(values.size() / width);
  impl_->rows.resize(size_local_rows);
  for (int row = 0; row < size_local_rows; row++) impl_->rows[row] = &values[row * width];
  vector_local = values.data();
  array_local = impl_->rows.data();
}

double ComputeWallTriangle::memory_usage() {
  return (impl_->values.capacity() + impl_->wear.capacity()) * sizeof(double) +
         impl_->rows.capacity() * sizeof(double *);
}

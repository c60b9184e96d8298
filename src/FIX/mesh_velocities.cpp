// SPDX-License-Identifier: GPL-2.0-or-later
#include "mesh_velocities.h"
#include "comm.h"
#include "tri_mesh.h"
#include <algorithm>
#include <map>
#include <utility>

namespace grainscope {

using LAMMPS_NS::MultiVectorContainer;
using LAMMPS_NS::TriMesh;

namespace {

using Velocities = MultiVectorContainer<double, 3, 3>;

/** Of each triangle and node, or null for a mesh that stands still. */
double ***velocities_of(TriMesh *mesh) {
  Velocities *found = mesh->prop().getElementProperty<Velocities>("v");
  return found ? found->begin() : nullptr;
}

/** As fix move/mesh makes them, whose set-up may come later. */
void make_velocities(TriMesh *mesh) {
  if (!mesh->prop().getElementProperty<Velocities>("v"))
    mesh->prop().addElementProperty<Velocities>("v", "comm_exchange_borders", "frame_invariant", "restart_no");
}

}

void MeshVelocities::keep(const std::vector<TriMesh *> &meshes) {
  std::vector<double> mine;
  for (std::size_t k = 0; k < meshes.size(); k++) {
    double ***const v = velocities_of(meshes[k]);
    for (int i = 0; v && i < meshes[k]->sizeLocal(); i++) {
      mine.push_back(k);
      mine.push_back(meshes[k]->id(i));
      mine.insert(mine.end(), v[i][0], v[i][0] + 9);
    }
  }
  int n = mine.size();
  std::vector<int> counts(comm->nprocs), starts(comm->nprocs + 1, 0);
  MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int rank = 0; rank < comm->nprocs; rank++) starts[rank + 1] = starts[rank] + counts[rank];
  numbers_.resize(starts.back());
  MPI_Allgatherv(mine.data(), n, MPI_DOUBLE, numbers_.data(), counts.data(), starts.data(), MPI_DOUBLE, world);
}

void MeshVelocities::restore(const std::vector<TriMesh *> &meshes) const {
  std::map<std::pair<int, int>, const double *> of;
  for (std::size_t at = 0; at < numbers_.size(); at += width)
    of[{static_cast<int>(numbers_[at]), static_cast<int>(numbers_[at + 1])}] = &numbers_[at + 2];
  for (std::size_t k = 0; k < meshes.size(); k++) {
    const auto moved = of.lower_bound({static_cast<int>(k), -1});
    if (moved != of.end() && moved->first.first == static_cast<int>(k)) make_velocities(meshes[k]);
    double ***const v = velocities_of(meshes[k]);
    for (int i = 0; v && i < meshes[k]->sizeLocal() + meshes[k]->sizeGhost(); i++) {
      const auto found = of.find({static_cast<int>(k), meshes[k]->id(i)});
      if (found != of.end()) std::copy(found->second, found->second + 9, v[i][0]);
      else std::fill_n(v[i][0], 9, 0.0);
    }
  }
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_WALL_TRIANGLE_SUMS_H
#define GRAINSCOPE_WALL_TRIANGLE_SUMS_H

#include "contact_measures.h"
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace grainscope {

/** Sums over the contacts of each triangle of some meshes, by the triangles' IDs; those of other walls are left out. */
class WallTriangleSums {
 public:
  enum Of { contacts, normal, friction, archard, width };

  /** Place of each wall, by PartnerWall::wall, among the meshes, or -1: left out; and how many IDs each mesh has. */
  void set_meshes(std::vector<int> mesh_of_wall, const std::vector<int> &triangles) {
    mesh_of_wall_ = std::move(mesh_of_wall);
    first_.assign(1, 0);
    for (int n : triangles) first_.push_back(first_.back() + n);
    sums_.assign(first_.back() * width, 0.0);
  }
  void reset() { std::fill(sums_.begin(), sums_.end(), 0.0); }
  void add(const Contact &c) {
    const PartnerWall &wall = c.wall();
    if (mesh_of_wall_[wall.wall] < 0) return;
    double *const at = &sums_[place(mesh_of_wall_[wall.wall], wall.triangle) * width];
    at[contacts] += c.weight;
    at[normal] += c.weight * c.normal_force;
    at[friction] += c.weight * friction_loss(c);
    at[archard] += c.weight * archard_rate(c);
  }
  std::vector<double> &numbers() { return sums_; }
  /** All triangles of all meshes, one after the other. */
  std::size_t triangles() const { return first_.back(); }
  std::size_t place(int mesh, int triangle) const { return first_[mesh] + triangle; }
  const double *at(std::size_t place) const { return &sums_[place * width]; }

 private:
  std::vector<int> mesh_of_wall_;
  std::vector<std::size_t> first_{0};
  std::vector<double> sums_;
};

}

#endif

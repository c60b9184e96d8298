// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_WALL_CONTACT_SUMS_H
#define GRAINSCOPE_WALL_CONTACT_SUMS_H

#include "contact_measures.h"
#include <Eigen/Geometry>
#include <array>
#include <utility>
#include <vector>

namespace grainscope {

/** Sums over the contacts of each of some walls; those of other walls are left out. */
class WallContactSums {
 public:
  enum Of {
    contacts,
    sliding,
    force,               // on the wall, three
    torque = force + 3,  // on the wall about `about`, three
    normal = torque + 3,
    shear,
    power,  // that the wall gives to the grains
    normal_damping,
    friction,
    tangential_damping,
    width
  };
  using Row = std::array<double, width>;

  WallContactSums() = default;
  explicit WallContactSums(Eigen::Vector3d about) : about_(std::move(about)) {}
  /** Row of each wall, by PartnerWall::wall; -1: left out. */
  void set_rows(std::vector<int> row_of_wall, int rows) {
    row_of_wall_ = std::move(row_of_wall);
    sums_.assign(static_cast<std::size_t>(rows) * width, 0.0);
  }

  void reset() { sums_.assign(sums_.size(), 0.0); }
  void add(const Contact &c) {
    const PartnerWall &wall = c.wall();
    const int row = row_of_wall_[wall.wall];
    if (row < 0) return;
    const ContactMotion &m = *c.motion;
    double *const at = &sums_[static_cast<std::size_t>(row) * width];
    Eigen::Vector3d on_wall = -(m.point - about_).cross(c.force);
    if (c.rolling) on_wall -= c.rolling->torque;
    for (int k = 0; k < 3; k++) {
      at[force + k] -= c.weight * c.force[k];
      at[torque + k] += c.weight * on_wall[k];
    }
    at[contacts] += c.weight;
    if (c.sliding) at[sliding] += c.weight;
    at[normal] += c.weight * c.normal_force;
    at[shear] += c.weight * c.tangential_force.norm();
    at[power] += c.weight * c.force.dot(wall.velocity);
    at[normal_damping] += c.weight * damping_loss(c);
    at[friction] += c.weight * friction_loss(c);
    at[tangential_damping] += c.weight * tangential_damping_loss(c);
  }
  std::vector<double> &numbers() { return sums_; }
  int rows() const { return static_cast<int>(sums_.size() / width); }
  Row of(int row) const {
    Row found;
    std::copy_n(sums_.begin() + static_cast<std::ptrdiff_t>(row) * width, width, found.begin());
    return found;
  }

 private:
  Eigen::Vector3d about_ = Eigen::Vector3d::Zero();
  std::vector<int> row_of_wall_;
  std::vector<double> sums_;
};

}

#endif

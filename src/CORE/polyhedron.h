// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_POLYHEDRON_H
#define GRAINSCOPE_POLYHEDRON_H

#include <Eigen/Core>
#include <vector>

namespace grainscope {

/** All x with normal . x <= distance; the plane itself is left out of an open one. The normal has length 1. */
struct HalfSpace {
  Eigen::Vector3d normal;
  double distance;
  bool open = false;

  /** > 0 outside. */
  double height(const Eigen::Vector3d &x) const { return normal.dot(x) - distance; }
};

/** A convex polyhedron that half spaces cut from a parallelepiped. */
class Polyhedron {
 public:
  /** By a corner and the edges from there, right-handed in columns. */
  Polyhedron(const Eigen::Vector3d &corner, const Eigen::Matrix3d &edges);

  void cut(const HalfSpace &keep);
  double volume() const;
  /** The six half spaces of the parallelepiped that it began as. */
  const std::vector<HalfSpace> &sides() const { return sides_; }

 private:
  using Polygon = std::vector<Eigen::Vector3d>;

  std::vector<Polygon> faces_;  // corners in turn, counter-clockwise from outside
  std::vector<HalfSpace> sides_;
  double rounding_;  // heights below it are none

  static Polygon part_below(const Polygon &face, const HalfSpace &keep, double rounding,
                            std::vector<Eigen::Vector3d> &on_plane);
  void close(std::vector<Eigen::Vector3d> &corners, const Eigen::Vector3d &normal);
};

}

#endif

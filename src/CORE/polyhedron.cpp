// SPDX-License-Identifier: GPL-2.0-or-later
#include "polyhedron.h"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace grainscope {

using Eigen::Vector3d;

Polyhedron::Polyhedron(const Vector3d &corner, const Eigen::Matrix3d &edges)
    : rounding_(1e-14 * (edges.cwiseAbs().sum() + corner.cwiseAbs().sum())) {
  for (int k = 0; k < 3; k++) {
    const Vector3d a = edges.col((k + 1) % 3), b = edges.col((k + 2) % 3), c = edges.col(k),
                   n = a.cross(b).normalized();
    faces_.push_back({corner, corner + b, corner + a + b, corner + a});
    faces_.push_back({corner + c, corner + c + a, corner + c + a + b, corner + c + b});
    sides_.push_back({-n, -n.dot(corner)});
    sides_.push_back({n, n.dot(corner + c)});
  }
}

/** The corners of what is left, and those that the plane made. */
Polyhedron::Polygon Polyhedron::part_below(const Polygon &face, const HalfSpace &keep, double rounding,
                                           std::vector<Vector3d> &on_plane) {
  Polygon below;
  for (std::size_t k = 0; k < face.size(); k++) {
    const Vector3d &here = face[k], &next = face[(k + 1) % face.size()];
    const double h = keep.height(here), h_next = keep.height(next);
    if (h <= rounding) below.push_back(here);
    if (std::fabs(h) <= rounding) on_plane.push_back(here);
    if ((h > rounding && h_next < -rounding) || (h < -rounding && h_next > rounding)) {
      below.push_back(here + h / (h - h_next) * (next - here));
      on_plane.push_back(below.back());
    }
  }
  return below;
}

/** The face on the plane, from corners that come twice and in any order. */
void Polyhedron::close(std::vector<Vector3d> &corners, const Vector3d &normal) {
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d &one : corners) middle += one / static_cast<double>(corners.size());
  const Vector3d first = normal.unitOrthogonal(), second = normal.cross(first);
  std::sort(corners.begin(), corners.end(), [&](const Vector3d &a, const Vector3d &b) {
    return std::atan2(second.dot(a - middle), first.dot(a - middle)) <
           std::atan2(second.dot(b - middle), first.dot(b - middle));
  });
  faces_.push_back(corners);
}

void Polyhedron::cut(const HalfSpace &keep) {
  bool above = false;
  for (const Polygon &face : faces_)
    for (const Vector3d &corner : face) above = above || keep.height(corner) > rounding_;
  if (!above) return;
  std::vector<Polygon> left;
  std::vector<Vector3d> on_plane;
  for (const Polygon &face : faces_) {
    const Polygon below = part_below(face, keep, rounding_, on_plane);
    if (below.size() > 2) left.push_back(below);
  }
  faces_ = left;
  if (!faces_.empty() && on_plane.size() > 2) close(on_plane, keep.normal);
}

double Polyhedron::volume() const {
  if (faces_.empty()) return 0.0;
  const Vector3d from = faces_[0][0];
  double six = 0.0;
  for (const Polygon &face : faces_)
    for (std::size_t k = 2; k < face.size(); k++)
      six += (face[0] - from).dot((face[k - 1] - from).cross(face[k] - from));
  return six / 6.0;
}

}

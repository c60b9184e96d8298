// SPDX-License-Identifier: GPL-2.0-or-later
#include "field_cells.h"
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace grainscope {

using Eigen::Matrix3d;
using Eigen::Vector3d;

FieldCells FieldCells::blocks(const Vector3d &corner, const Matrix3d &edges, const Numbers &numbers,
                              const std::array<bool, 3> &open) {
  FieldCells cells;
  cells.corner_ = corner;
  cells.edges_ = edges;
  cells.numbers_ = numbers;
  cells.open_ = open;
  cells.inverse_ = edges.inverse();
  for (int k = 0; k < 3; k++) cells.inverse_.row(k) *= numbers[k];
  return cells;
}

FieldCells FieldCells::rings(int along, const Vector3d &centre, const std::array<double, 2> &radii,
                             const std::array<double, 2> &places, const Numbers &numbers, bool open) {
  FieldCells cells;
  cells.rings_ = true;
  cells.along_ = along;
  cells.centre_ = centre;
  cells.radii_ = radii;
  cells.places_ = places;
  cells.numbers_ = numbers;
  cells.open_ = {{false, true, open}};
  cells.corner_ = centre - Vector3d::Constant(radii[1]);
  cells.edges_ = 2.0 * radii[1] * Matrix3d::Identity();
  cells.corner_[along] = places[0];
  cells.edges_(along, along) = places[1] - places[0];
  return cells;
}

double FieldCells::volume(int cell) const {
  if (!rings_) return edges_.determinant() / count();
  const double width = (radii_[1] - radii_[0]) / numbers_[0], inner = radii_[0] + place(cell)[0] * width;
  return M_PI * width * (2.0 * inner + width) * (places_[1] - places_[0]) / numbers_[2];
}

Vector3d FieldCells::middle(int cell) const {
  const Numbers at = place(cell);
  if (rings_)
    return {radii_[0] + (at[0] + 0.5) * (radii_[1] - radii_[0]) / numbers_[0], 0.0,
            places_[0] + (at[2] + 0.5) * (places_[1] - places_[0]) / numbers_[2]};
  Vector3d s;
  for (int k = 0; k < 3; k++) s[k] = (at[k] + 0.5) / numbers_[k];
  return corner_ + edges_ * s;
}

Vector3d FieldCells::position(const Vector3d &x) const {
  if (!rings_) return x;
  Vector3d across = x - centre_;
  across[along_] = 0.0;
  return {across.norm(), 0.0, x[along_]};
}

Matrix3d FieldCells::frame(const Vector3d &x) const {
  if (!rings_) return Matrix3d::Identity();
  Vector3d across = x - centre_;
  across[along_] = 0.0;
  const double radius = across.norm();
  const Vector3d axis = Vector3d::Unit(along_);
  const Vector3d outwards = radius > 0.0 ? Vector3d(across / radius) : Vector3d(Vector3d::Unit((along_ + 1) % 3));
  Matrix3d rows;
  rows << outwards.transpose(), axis.cross(outwards).transpose(), axis.transpose();
  return rows;
}

Vector3d FieldCells::ring_coordinates(const Vector3d &x) const {
  const Vector3d at = position(x);
  return {(at[0] - radii_[0]) / (radii_[1] - radii_[0]) * numbers_[0], 0.5,
          (at[2] - places_[0]) / (places_[1] - places_[0]) * numbers_[2]};
}

void FieldCells::find_cuts(const Vector3d &from, const Vector3d &to, double low, double high) const {
  const Vector3d a = coordinates(from), b = coordinates(to);
  if (!rings_)
    for (int k = 0; k < 2; k++)
      if (numbers_[k] > 1 || !open_[k]) cut_across(k, a[k], b[k], low, high);
  if (numbers_[2] > 1 || !open_[2]) cut_across(2, a[2], b[2], low, high);
  if (rings_) cut_by_radii(from, to, low, high);
}

/** By the planes between cells along axis k, from and to in units of cells. */
void FieldCells::cut_across(int k, double from, double to, double low, double high) const {
  const double first = open_[k] ? 1.0 : 0.0, last = open_[k] ? numbers_[k] - 1.0 : numbers_[k];
  const double begin = std::max(first, std::ceil(std::min(from, to)));
  const double end = std::min(last, std::floor(std::max(from, to)));
  for (double plane = begin; plane <= end; plane++)
    if (from != to) add_cut((plane - from) / (to - from), low, high);
}

/** By the cylinders between rings. */
void FieldCells::cut_by_radii(const Vector3d &from, const Vector3d &to, double low, double high) const {
  Vector3d p = from - centre_, d = to - from;
  p[along_] = d[along_] = 0.0;
  const double dd = d.squaredNorm(), pd = p.dot(d), width = (radii_[1] - radii_[0]) / numbers_[0];
  if (dd == 0.0) return;
  const double nearest = std::sqrt(std::max(0.0, p.squaredNorm() - pd * pd / dd));
  const double farthest = std::sqrt(std::max(p.squaredNorm(), (p + d).squaredNorm()));
  const double begin = std::max(0.0, std::ceil((nearest - radii_[0]) / width));
  const double end = std::min<double>(numbers_[0], std::floor((farthest - radii_[0]) / width));
  for (double ring = begin; ring <= end; ring++) {
    const double radius = radii_[0] + ring * width;
    const double root = pd * pd - dd * (p.squaredNorm() - radius * radius);
    if (root <= 0.0) continue;
    add_cut((-pd - std::sqrt(root)) / dd, low, high);
    add_cut((-pd + std::sqrt(root)) / dd, low, high);
  }
}

}

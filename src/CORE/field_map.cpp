// SPDX-License-Identifier: GPL-2.0-or-later
#include "field_map.h"
#include <Eigen/Geometry>
#include <Eigen/LU>

namespace grainscope {

using Eigen::Matrix3d;
using Eigen::Vector3d;

FieldMap::FieldMap(const FieldCells &cells, const Space &space, bool with_box, const std::array<bool, 3> &whole,
                   FieldKernel::Kind kind, double width)
    : cells_(cells), space_(space) {
  int dimensions = 0;
  for (int k = 0; k < 3; k++) {
    divided_[k] = cells.numbers()[k] > 1;
    open_[k] = cells.open(k);
    dimensions += divided_[k];
  }
  if (kind != FieldKernel::Kind::cell && dimensions > 0) kernel_ = FieldKernel(kind, width, dimensions);
  find_measure();
  find_view(with_box, whole);
}

/** Of cells in the space of the axes that are divided, and how to come there. */
void FieldMap::find_measure() {
  if (cells_.are_rings()) {  // radius and axis are at right angles
    for (int k = 0; k < 3; k++)
      if (!divided_[k]) across_(k, k) = 0.0;
    return;
  }
  const Matrix3d &e = cells_.edges();
  std::vector<Vector3d> whole;
  for (int k = 0; k < 3; k++)
    if (!divided_[k]) whole.push_back(e.col(k));
  double size = 1.0;
  if (whole.size() == 1) {
    size = whole[0].norm();
    across_ = Matrix3d::Identity() - whole[0] * whole[0].transpose() / whole[0].squaredNorm();
  }
  if (whole.size() == 3) across_.setZero();
  if (whole.size() == 2) {
    const Vector3d normal = whole[0].cross(whole[1]);
    size = normal.norm();
    across_ = normal * normal.transpose() / normal.squaredNorm();
  }
  if (!kernel_.is_smooth()) return;
  measure_ = cells_.volume(0) / size;
  const Matrix3d to_cells = e.inverse();
  for (int k = 0; k < 3; k++)
    if (divided_[k]) reach_[k] = kernel_.range() * to_cells.row(k).norm() * cells_.numbers()[k];
}

/** Between which coordinates a cell sees. */
void FieldMap::find_view(bool with_box, const std::array<bool, 3> &whole) {
  if (with_box) to_view_ = space_.edges.inverse();
  else lattice_ = space_.edges;
  low_.setConstant(HUGE_VAL);
  high_.setConstant(-HUGE_VAL);
  for (int corner = 0; corner < 8; corner++) {
    const Vector3d at(corner & 1, corner >> 1 & 1, corner >> 2);
    const Vector3d s = to_view_ * (cells_.corner() + cells_.edges() * at - space_.corner);
    low_ = low_.cwiseMin(s);
    high_ = high_.cwiseMax(s);
  }
  for (int k = 0; k < 3; k++) {
    cut_[k] = space_.periodic[k] && whole[k] && !(kernel_.is_smooth() && divided_[k]);
    if (!kernel_.is_smooth() || !divided_[k]) continue;
    const double reach = kernel_.range() * to_view_.row(k).norm();
    low_[k] -= reach;
    high_[k] += reach;
  }
}

/** Leaves of the line from u to v what lies between 0 and 1. */
void FieldMap::clip(double u, double v, double &low, double &high) {
  if (u == v) {
    if (!(u >= 0.0 && u < 1.0)) high = low;
    return;
  }
  const double enters = -u / (v - u), leaves = (1.0 - u) / (v - u);
  low = std::max(low, std::min(enters, leaves));
  high = std::min(high, std::max(enters, leaves));
}

}

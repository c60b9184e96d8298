// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FIELD_MAP_H
#define GRAINSCOPE_FIELD_MAP_H

#include "field_cells.h"
#include "field_kernel.h"
#include <cmath>

namespace grainscope {

/** To which cells, in which parts, points and lines of a periodic box belong: with kernel cell to those that hold them;
 *  with a smooth one to all whose middles are near, by phi(middle - x) times the cell's volume, where phi is a function
 *  of the axes that are divided. */
class FieldMap {
 public:
  /** The periodic space that cells lie in. */
  struct Space {
    Eigen::Vector3d corner = Eigen::Vector3d::Zero();
    Eigen::Matrix3d edges = Eigen::Matrix3d::Identity();
    std::array<bool, 3> periodic{{false, false, false}};
  };

  FieldMap() = default;
  /** `with_box`: the cells divide the box, or a part of it, along its own edges. `width`: of a smooth kernel. */
  FieldMap(const FieldCells &cells, const Space &space, bool with_box, FieldKernel::Kind kind, double width);

  const FieldCells &cells() const { return cells_; }
  /** Projects on the space of the axes that are divided, at right angles to the edges of those that are not. */
  const Eigen::Matrix3d &across() const { return across_; }
  /** Calls use(cell, weight, boxes): `boxes` is by how many edges the image that the cell sees is moved. */
  template <class Use>
  void for_each_at(const Eigen::Vector3d &x, const Use &use) const {
    for_each_image(x, x, [&](const Eigen::Vector3d &boxes, double, double) {
      const Eigen::Vector3d at = x + space_.edges * boxes;
      if (!kernel_.is_smooth()) {
        const int cell = cells_.cell_of(at);
        if (cell >= 0) use(cell, 1.0, boxes);
        return;
      }
      const Eigen::Vector3d u = cells_.coordinates(at);
      for (int k = 0; k < 3; k++)
        if (!divided_[k] && !(u[k] >= 0.0 && u[k] < 1.0) && !open_[k]) return;
      for_each_near(u, u, [&](int cell) {
        const double value = kernel_.at((across_ * (at - cells_.middle(cell))).squaredNorm());
        if (value > 0.0) use(cell, value * measure_, boxes);
      });
    });
  }

  /** Calls use(cell, share, middle) for parts of the line from a to b: the share of it, and the middle of what lies in
   *  the cell, of smooth kernels that of the whole line. */
  template <class Use>
  void for_each_along(const Eigen::Vector3d &a, const Eigen::Vector3d &b, const Use &use) const {
    for_each_image(a, b, [&](const Eigen::Vector3d &boxes, double low, double high) {
      const Eigen::Vector3d shift = space_.edges * boxes, from = a + shift, to = b + shift;
      if (!kernel_.is_smooth()) {
        cells_.for_each_part(from, to, low, high, [&](int cell, double first, double last) {
          use(cell, last - first, Eigen::Vector3d(from + 0.5 * (first + last) * (to - from)));
        });
        return;
      }
      const Eigen::Vector3d u = cells_.coordinates(from), v = cells_.coordinates(to);
      for (int k = 0; k < 3; k++)
        if (!divided_[k] && !open_[k]) clip(u[k], v[k], low, high);
      if (low >= high) return;
      const Eigen::Vector3d direction = across_ * (to - from);
      for_each_near(u, v, [&](int cell) {
        const double value = kernel_.along(across_ * (from - cells_.middle(cell)), direction, low, high);
        if (value > 0.0) use(cell, value * measure_, Eigen::Vector3d(0.5 * (from + to)));
      });
    });
  }

 private:
  FieldCells cells_;
  Space space_;
  bool with_box_ = true;
  FieldKernel kernel_;
  std::array<bool, 3> divided_{{true, true, true}}, open_{{false, false, false}};
  Eigen::Matrix3d inverse_ = Eigen::Matrix3d::Identity();  // of the edges of space
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero(),
                  high_ = Eigen::Vector3d::Ones();  // in units of those edges, what is seen
  Eigen::Matrix3d across_ = Eigen::Matrix3d::Identity();
  double measure_ = 1.0;                             // of a cell in that space
  Eigen::Vector3d reach_ = Eigen::Vector3d::Zero();  // of the kernel, in cells

  void find_measure();
  void find_view();
  static void clip(double u, double v, double &low, double &high);

  /** The images of the line that may be seen, and the part of it that may. */
  template <class Use>
  void for_each_image(const Eigen::Vector3d &a, const Eigen::Vector3d &b, const Use &use) const {
    const Eigen::Vector3d s = inverse_ * (a - space_.corner), t = inverse_ * (b - space_.corner);
    if (!((s + t).allFinite())) return;
    int first[3] = {0, 0, 0}, last[3] = {0, 0, 0};
    bool cut[3] = {false, false, false};  // at the faces of the box
    for (int k = 0; k < 3; k++) {
      if (!space_.periodic[k]) continue;
      const double least = std::min(s[k], t[k]), most = std::max(s[k], t[k]);
      cut[k] = with_box_ && !(kernel_.is_smooth() && divided_[k]);
      first[k] = static_cast<int>(cut[k] ? -std::floor(most) : std::ceil(low_[k] - most));
      last[k] = static_cast<int>(cut[k] ? -std::floor(least) : std::floor(high_[k] - least));
    }
    Eigen::Vector3d boxes;
    for (boxes[0] = first[0]; boxes[0] <= last[0]; boxes[0]++)
      for (boxes[1] = first[1]; boxes[1] <= last[1]; boxes[1]++)
        for (boxes[2] = first[2]; boxes[2] <= last[2]; boxes[2]++) {
          double low = 0.0, high = 1.0;
          for (int k = 0; k < 3; k++)
            if (cut[k] && first[k] < last[k]) clip(s[k] + boxes[k], t[k] + boxes[k], low, high);
          if (low < high) use(boxes, low, high);
        }
  }

  /** The cells whose middles are within the kernel's range of the line between two points, in units of cells, and some
   *  more. */
  template <class Use>
  void for_each_near(const Eigen::Vector3d &u, const Eigen::Vector3d &v, const Use &use) const {
    int first[3] = {0, 0, 0}, last[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
      if (!divided_[k]) continue;
      first[k] = static_cast<int>(std::max(0.0, std::ceil(std::min(u[k], v[k]) - reach_[k] - 0.5)));
      last[k] =
          static_cast<int>(std::min(cells_.numbers()[k] - 1.0, std::floor(std::max(u[k], v[k]) + reach_[k] - 0.5)));
    }
    for (int z = first[2]; z <= last[2]; z++)
      for (int y = first[1]; y <= last[1]; y++)
        for (int x = first[0]; x <= last[0]; x++) use(cells_.cell({{x, y, z}}));
  }
};

}

#endif

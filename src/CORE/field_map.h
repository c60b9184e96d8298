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
  static constexpr double rounding = 1e-9;  // of a period: what is so near to an end may be seen

 public:
  /** The periodic space that cells lie in, the edges an upper triangular matrix. */
  struct Space {
    Eigen::Vector3d corner = Eigen::Vector3d::Zero();
    Eigen::Matrix3d edges = Eigen::Matrix3d::Identity();
    std::array<bool, 3> periodic{{false, false, false}};
  };

  FieldMap() = default;
  /** `with_box`: the cells divide the box, or a part of it, along its own edges. `whole`: axes of space along which
   *  they are one whole period, so that each point and each part of a line has one image there. `width`: of a smooth
   *  kernel. */
  FieldMap(const FieldCells &cells, const Space &space, bool with_box, const std::array<bool, 3> &whole,
           FieldKernel::Kind kind, double width);

  /** How many images of space along axis k lie between what is seen from cells. */
  double images(int k) const { return space_.periodic[k] ? (high_[k] - low_[k]) / lattice_(k, k) : 0.0; }
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
  FieldKernel kernel_;
  std::array<bool, 3> divided_{{true, true, true}}, open_{{false, false, false}};
  std::array<bool, 3> cut_{{false, false, false}};  // axes of space along which images are cut at their ends
  // Coordinates that images are found in: with the box its fractions, else x, y, z. Images are moved by whole numbers
  // of the lattice's columns; axis k of an image does not depend on lower ones.
  Eigen::Matrix3d to_view_ = Eigen::Matrix3d::Identity(), lattice_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero(), high_ = Eigen::Vector3d::Ones();  // what is seen, there
  Eigen::Matrix3d across_ = Eigen::Matrix3d::Identity();
  double measure_ = 1.0;                             // of a cell in that space
  Eigen::Vector3d reach_ = Eigen::Vector3d::Zero();  // of the kernel, in cells

  void find_measure();
  void find_view(bool with_box, const std::array<bool, 3> &whole);
  static void clip(double u, double v, double &low, double &high);

  /** The images of the line that may be seen, and the part of each that may. */
  template <class Use>
  void for_each_image(const Eigen::Vector3d &a, const Eigen::Vector3d &b, const Use &use) const {
    const Eigen::Vector3d from = to_view_ * (a - space_.corner), to = to_view_ * (b - space_.corner);
    if (!((from + to).allFinite())) return;
    Eigen::Vector3d boxes = Eigen::Vector3d::Zero();
    find_images(2, from, to, 0.0, 1.0, boxes, use);
  }

  /** Along axis k and those below, of the part of the line from `low` to `high`. */
  template <class Use>
  void find_images(int k, const Eigen::Vector3d &from, const Eigen::Vector3d &to, double low, double high,
                   Eigen::Vector3d &boxes, const Use &use) const {
    if (k < 0) return use(boxes, low, high);
    if (!space_.periodic[k]) return find_images(k - 1, from, to, low, high, boxes, use);
    const double period = lattice_(k, k), shifted = lattice_.row(k).dot(boxes) - low_[k];
    const double u = (from[k] + shifted) / period, v = (to[k] + shifted) / period;  // from the lower end
    const double at_low = u + low * (v - u), at_high = u + high * (v - u);
    const double least = std::min(at_low, at_high), most = std::max(at_low, at_high);
    const double first = cut_[k] ? -std::floor(most) : std::ceil(-most - rounding);
    const double last = cut_[k] ? -std::floor(least) : std::floor((high_[k] - low_[k]) / period - least + rounding);
    for (double n = first; n <= last; n++) {
      double begin = low, end = high;
      if (cut_[k] && first < last) clip(u + n, v + n, begin, end);
      if (begin >= end) continue;
      boxes[k] = n;
      find_images(k - 1, from, to, begin, end, boxes, use);
    }
    boxes[k] = 0.0;
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

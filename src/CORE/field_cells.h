// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FIELD_CELLS_H
#define GRAINSCOPE_FIELD_CELLS_H

#include "bin_index.h"
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <vector>

namespace grainscope {

/** A part of space divided into cells: a block along three edges, or rings about an axis. Cells are numbered with the
 *  first axis fastest; the axes of rings are the radius, the azimuth, which is not divided, and the axis. */
class FieldCells {
 public:
  using Numbers = std::array<int, 3>;

  FieldCells() = default;
  /** Between the edges, in columns of an upper triangular matrix, of a block. Across axis k with `open[k]` the first
   *  and the last cell hold what lies beyond them too. */
  static FieldCells blocks(const Eigen::Vector3d &corner, const Eigen::Matrix3d &edges, const Numbers &numbers,
                           const std::array<bool, 3> &open);
  /** About the line along x, y or z (0, 1, 2) through `centre`, between two radii and two places along the axis, from
   *  0; `open`: the first and last along the axis. */
  static FieldCells rings(int along, const Eigen::Vector3d &centre, const std::array<double, 2> &radii,
                          const std::array<double, 2> &places, const Numbers &numbers, bool open);

  int count() const { return numbers_[0] * numbers_[1] * numbers_[2]; }
  const Numbers &numbers() const { return numbers_; }
  bool are_rings() const { return rings_; }
  bool open(int k) const { return open_[k]; }
  /** Of a block, the edges that `numbers` divide; of rings those of the block that holds them. */
  const Eigen::Matrix3d &edges() const { return edges_; }
  const Eigen::Vector3d &corner() const { return corner_; }
  /** Of the coordinates that rows are numbered along: corner and edges, of rings by radius, azimuth and axis. */
  Eigen::Vector3d first_corner() const { return rings_ ? Eigen::Vector3d(radii_[0], 0.0, places_[0]) : corner_; }
  Eigen::Matrix3d numbered_edges() const {
    if (!rings_) return edges_;
    return Eigen::Vector3d(radii_[1] - radii_[0], 1.0, places_[1] - places_[0]).asDiagonal();
  }
  int cell(const Numbers &at) const { return at[0] + numbers_[0] * (at[1] + numbers_[1] * at[2]); }
  Numbers place(int cell) const {
    return {{cell % numbers_[0], cell / numbers_[0] % numbers_[1], cell / (numbers_[0] * numbers_[1])}};
  }

  double volume(int cell) const;
  /** Of its middle, and of any point: x, y, z, of rings radius, 0 and the place along the axis. */
  Eigen::Vector3d middle(int cell) const;
  Eigen::Vector3d position(const Eigen::Vector3d &x) const;
  /** Unit vectors that components are along, in rows: x, y, z; of rings those of the radius, the azimuth and the axis
   *  at x. */
  Eigen::Matrix3d frame(const Eigen::Vector3d &x) const;
  /** -1 for none. */
  int cell_of(const Eigen::Vector3d &x) const { return cell_at(coordinates(x)); }
  /** In units of cells, inside from 0 to the number of cells along each axis. */
  Eigen::Vector3d coordinates(const Eigen::Vector3d &x) const {
    if (rings_) return ring_coordinates(x);
    const Eigen::Vector3d d = x - corner_;
    const Eigen::Matrix3d &m = inverse_;  // upper triangular
    return {m(0, 0) * d[0] + m(0, 1) * d[1] + m(0, 2) * d[2], m(1, 1) * d[1] + m(1, 2) * d[2], m(2, 2) * d[2]};
  }

  /** Calls use(cell, first, last) for the parts of a line that lie in one cell each, of what is between `low` and
   *  `high` of it: from 0, its beginning, to 1, its end. */
  template <class Use>
  void for_each_part(const Eigen::Vector3d &from, const Eigen::Vector3d &to, double low, double high,
                     const Use &use) const {
    cuts_.clear();
    cuts_.push_back(low);
    find_cuts(from, to, low, high);
    std::sort(cuts_.begin() + 1, cuts_.end());
    cuts_.push_back(high);
    for (std::size_t k = 1; k < cuts_.size(); k++) {
      if (cuts_[k - 1] >= cuts_[k]) continue;
      const int cell = cell_of(from + 0.5 * (cuts_[k - 1] + cuts_[k]) * (to - from));
      if (cell >= 0) use(cell, cuts_[k - 1], cuts_[k]);
    }
  }

 private:
  bool rings_ = false;
  Numbers numbers_{{1, 1, 1}};
  std::array<bool, 3> open_{{false, false, false}};
  Eigen::Vector3d corner_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d edges_ = Eigen::Matrix3d::Identity(), inverse_ = Eigen::Matrix3d::Identity();
  int along_ = 2;  // of rings
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  std::array<double, 2> radii_{{0.0, 1.0}}, places_{{0.0, 1.0}};
  mutable std::vector<double> cuts_;  // room for what one call finds

  Eigen::Vector3d ring_coordinates(const Eigen::Vector3d &x) const;
  int cell_at(const Eigen::Vector3d &u) const {
    Numbers at;
    for (int k = 0; k < 3; k++) {
      at[k] = open_[k] ? nearest_bin_index(u[k], numbers_[k]) : bin_index(u[k], numbers_[k]);
      if (at[k] < 0) return -1;
    }
    return cell(at);
  }
  void find_cuts(const Eigen::Vector3d &from, const Eigen::Vector3d &to, double low, double high) const;
  void cut_across(int k, double from, double to, double low, double high) const;
  void cut_by_radii(const Eigen::Vector3d &from, const Eigen::Vector3d &to, double low, double high) const;
  void add_cut(double at, double low, double high) const {
    if (at > low && at < high) cuts_.push_back(at);
  }
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FIELD_SETTINGS_H
#define GRAINSCOPE_FIELD_SETTINGS_H

#include "box_state.h"
#include "field_map.h"
#include <array>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace grainscope {

class Arguments;

/** The grid of a field: its keywords, and the cells that they define in the present box. */
class FieldSettings {
 public:
  static std::vector<std::string> keywords();
  /** Reads what follows `keyword` when it is one of these. */
  bool read(Arguments &arguments, const std::string &keyword);
  /** Errors when words are missing or do not go together. */
  void complete(const Arguments &errors);
  /** Before use: finds the region at its present place. Errors when it does not exist, or is not a block at rest. */
  void find_region(LAMMPS_NS::LAMMPS *lmp, const std::string &style);
  /** Radii that were not given reach to the nearest face of the present box, from then on. */
  void fix_radii(const BoxState &box);

  /** Errors for a grid that two dimensions do not have. */
  void require_dimension(const Arguments &errors, int dimension) const;

  int cells() const { return numbers_[0] * numbers_[1] * numbers_[2]; }
  bool are_rings() const { return about_ >= 0; }
  bool is_smooth() const { return kernel_ != FieldKernel::Kind::cell; }
  /** The cells as the box is. */
  FieldMap map(const BoxState &box) const;
  /** Errors if there are no cells, or if they cover more images of the box than can be intended. */
  void require_cells(const Arguments &errors, const BoxState &box) const;
  bool moves_with_box() const { return frame_ == Frame::box; }
  /** Along which axes the last cell is followed by the first, in the next image of the box. */
  std::array<bool, 3> wraps(const BoxState &box) const;
  /** In columns, by how much that image is faster, in components of the cells. */
  Eigen::Matrix3d jumps(const BoxState &box) const;

 private:
  using Bounds = std::array<double, 2>;
  enum class Frame { automatic, box, lab } frame_ = Frame::automatic;
  std::array<int, 3> numbers_{{0, 0, 0}};
  std::array<bool, 3> bounded_{{false, false, false}};
  std::array<Bounds, 3> bounds_{};
  std::string region_;
  int about_ = -1;  // axis of rings
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  bool has_radii_ = false;
  Bounds radii_{};
  FieldKernel::Kind kernel_ = FieldKernel::Kind::cell;
  bool has_width_ = false;
  double width_ = 0.0;

  void read_bounds(Arguments &arguments, const std::string &keyword, Bounds &bounds);
  void read_about(Arguments &arguments);
  void complete_rings(const Arguments &errors);
  Bounds extent(const BoxState &box, int k) const;
  bool spans(const BoxState &box, int k) const;
  FieldCells blocks(const BoxState &box) const;
  FieldCells rings(const BoxState &box) const;
};

}

#endif

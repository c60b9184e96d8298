// SPDX-License-Identifier: GPL-2.0-or-later
#include "field_settings.h"
#include "arguments.h"
#include "region_shape.h"
#include "domain.h"
#include "lammps.h"
#include <algorithm>
#include <cmath>

namespace grainscope {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

const int most_cells = 10000000;
const double most_images = 100.0;
const double infinite = 1e19;  // less than what INF is to the host

bool any_number(double) { return true; }
bool is_positive(double x) { return x > 0.0; }

Vector3d corner_of(const BoxState &box) { return box.cell_centre - 0.5 * box.edges.rowwise().sum(); }

}

std::vector<std::string> FieldSettings::keywords() {
  return {"grid", "x", "y", "z", "region", "frame", "about", "r", "kernel", "width"};
}

bool FieldSettings::read(Arguments &arguments, const std::string &keyword) {
  if (keyword == "grid") {
    for (int &number : numbers_) number = arguments.whole_number(keyword, 1, most_cells);
    if (static_cast<double>(numbers_[0]) * numbers_[1] * numbers_[2] > most_cells)
      arguments.fail("grid", "at most " + std::to_string(most_cells) + " cells",
                     std::to_string(numbers_[0]) + " " + std::to_string(numbers_[1]) + " " +
                         std::to_string(numbers_[2]));
  } else if (keyword == "x" || keyword == "y" || keyword == "z") {
    const int axis = keyword[0] - 'x';
    bounded_[axis] = true;
    read_bounds(arguments, keyword, bounds_[axis]);
  } else if (keyword == "r") {
    has_radii_ = true;
    read_bounds(arguments, keyword, radii_);
    if (radii_[0] < 0.0) arguments.fail("r", "radii, not negative", Arguments::text(radii_[0]));
  } else if (keyword == "region") region_ = arguments.word("the ID of a region");
  else if (keyword == "frame") frame_ = arguments.choice(keyword, {"box", "lab"}) == "box" ? Frame::box : Frame::lab;
  else if (keyword == "about") read_about(arguments);
  else if (keyword == "kernel") {
    const std::string kind = arguments.choice(keyword, {"cell", "lucy", "gaussian"});
    kernel_ = kind == "cell"   ? FieldKernel::Kind::cell
              : kind == "lucy" ? FieldKernel::Kind::lucy
                               : FieldKernel::Kind::gaussian;
  } else if (keyword == "width") {
    has_width_ = true;
    width_ = arguments.number(keyword, "a positive length", is_positive);
  } else return false;
  return true;
}

void FieldSettings::read_bounds(Arguments &arguments, const std::string &keyword, Bounds &bounds) {
  for (double &bound : bounds) bound = arguments.number(keyword, "two numbers, the lower one first", any_number);
  if (!(bounds[0] < bounds[1]))
    arguments.fail(keyword, "two numbers, the lower one first",
                   Arguments::text(bounds[0]) + " " + Arguments::text(bounds[1]));
}

/** As the host's cylinders: the axis, then the two coordinates across it. */
void FieldSettings::read_about(Arguments &arguments) {
  about_ = arguments.choice("about", {"x", "y", "z"})[0] - 'x';
  for (int k = 0; k < 3; k++)
    if (k != about_) centre_[k] = arguments.number("about", "the place of the axis, two coordinates", any_number);
}

void FieldSettings::complete(const Arguments &errors) {
  if (numbers_[0] == 0) errors.fail("needs 'grid nx ny nz'");
  const bool bounded = bounded_[0] || bounded_[1] || bounded_[2];
  if (is_smooth() != has_width_)
    errors.fail(has_width_ ? "'width' needs 'kernel lucy' or 'kernel gaussian', got 'kernel cell'"
                           : "'kernel lucy' and 'kernel gaussian' need 'width w'");
  if (!region_.empty() && bounded)
    errors.fail("'region' excludes 'x', 'y' and 'z': give the bounds by one or the other");
  if (frame_ == Frame::automatic) frame_ = bounded || !region_.empty() || are_rings() ? Frame::lab : Frame::box;
  if (frame_ == Frame::box && !region_.empty())
    errors.fail("'region' needs 'frame lab', got 'frame box': a region does not move with the box");
  if (frame_ == Frame::box)
    for (int k = 0; k < 3; k++)
      if (bounded_[k] && (bounds_[k][0] < 0.0 || bounds_[k][1] > 1.0))
        errors.fail(std::string(1, static_cast<char>('x' + k)),
                    "from 0 to 1 with 'frame box', fractions of the box's edge",
                    Arguments::text(bounds_[k][0]) + " " + Arguments::text(bounds_[k][1]));
  if (are_rings()) complete_rings(errors);
  else if (has_radii_) errors.fail("'r' needs 'about x|y|z c1 c2'");
}

void FieldSettings::complete_rings(const Arguments &errors) {
  if (is_smooth()) errors.fail("kernel", "cell with 'about'", kernel_ == FieldKernel::Kind::lucy ? "lucy" : "gaussian");
  if (frame_ == Frame::box) errors.fail("'about' needs 'frame lab', got 'frame box'");
  if (!region_.empty()) errors.fail("'about' excludes 'region': give 'r' and bounds along the axis");
  if (numbers_[1] != 1)
    errors.fail("grid", "nr 1 nz with 'about'",
                std::to_string(numbers_[0]) + " " + std::to_string(numbers_[1]) + " " + std::to_string(numbers_[2]));
  for (int k = 0; k < 3; k++)
    if (k != about_ && bounded_[k])
      errors.fail(std::string("'about ") + "xyz"[about_] + "' takes bounds by 'r' and '" + "xyz"[about_] + "', got '" +
                  "xyz"[k] + "'");
}

void FieldSettings::find_region(LAMMPS_NS::LAMMPS *lmp, const std::string &style) {
  if (region_.empty()) return;
  const Arguments errors(lmp, style);
  const int found = lmp->domain->find_region(const_cast<char *>(region_.c_str()));
  if (found < 0) errors.fail("region", "a region that is defined", region_);
  LAMMPS_NS::Region *const region = lmp->domain->regions[found];
  Vector3d low, high;
  if (!is_standing_block(region, low, high))
    errors.fail("region '" + region_ + "' must be the inside of a block that does not move");
  for (int k = 0; k < 3; k++) {
    const bool from = low[k] > -infinite, to = high[k] < infinite;
    if (from != to)
      errors.fail("region '" + region_ + "' must have two bounds or two INF along each axis, got one INF");
    if (k == 2 && lmp->domain->dimension == 2) continue;  // the grains' plane is in it
    bounded_[k] = from;
    bounds_[k] = {{low[k], high[k]}};
    if (!(low[k] < high[k])) errors.fail("region '" + region_ + "' has no thickness along " + "xyz"[k]);
  }
}

void FieldSettings::require_dimension(const Arguments &errors, int dimension) const {
  if (dimension == 3) return;
  if (numbers_[2] != 1) errors.fail("grid", "nx ny 1 with 'dimension 2'", std::to_string(numbers_[2]) + " along z");
  if (bounded_[2]) errors.fail("'z' needs 'dimension 3', got 'dimension 2'");
  if (are_rings() && about_ != 2) errors.fail("'about' must be z with 'dimension 2'");
}

/** Along axis k in space. */
FieldSettings::Bounds FieldSettings::extent(const BoxState &box, int k) const {
  if (bounded_[k]) return bounds_[k];
  const double low = corner_of(box)[k];
  return {{low, low + box.edges(k, k)}};
}

/** Along axis k of the box it is one whole period. */
bool FieldSettings::spans(const BoxState &box, int k) const {
  if (!box.periodic[k] || (are_rings() && k != about_)) return false;
  if (frame_ == Frame::box) return !bounded_[k] || (bounds_[k][0] == 0.0 && bounds_[k][1] == 1.0);
  const Bounds all = extent(box, k);
  return std::fabs(all[1] - all[0] - box.edges(k, k)) < 1e-9 * box.edges(k, k);
}

FieldMap FieldSettings::map(const BoxState &box) const {
  const FieldMap::Space space = {corner_of(box), box.edges, box.periodic};
  return FieldMap(are_rings() ? rings(box) : blocks(box), space, frame_ == Frame::box,
                  {{spans(box, 0), spans(box, 1), spans(box, 2)}}, kernel_, width_);
}

void FieldSettings::require_cells(const Arguments &errors, const BoxState &box) const {
  if (are_rings() && !(radii_[0] < radii_[1]))
    errors.fail("the axis of rings must lie in the box, or 'r lo hi' must be given");
  const FieldMap map = this->map(box);
  for (int k = 0; k < 3; k++)
    if (!(map.images(k) < most_images))
      errors.fail("the grid and its kernel cover " + Arguments::text(map.images(k)) + " images of the box along " +
                  "xyz"[k] + ", at most " + Arguments::text(most_images) + ": use closer bounds or a smaller 'width'");
}

FieldCells FieldSettings::blocks(const BoxState &box) const {
  Vector3d corner = corner_of(box);
  Matrix3d edges = frame_ == Frame::box ? box.edges : Matrix3d::Zero();
  std::array<bool, 3> open;
  for (int k = 0; k < 3; k++) {
    if (frame_ == Frame::box) {
      if (bounded_[k]) corner += bounds_[k][0] * box.edges.col(k);
      if (bounded_[k]) edges.col(k) *= bounds_[k][1] - bounds_[k][0];
      open[k] = !bounded_[k] || spans(box, k);  // what is in the periodic box is in its cells, whatever rounding says
      continue;
    }
    const Bounds all = extent(box, k);
    corner[k] = all[0];
    edges(k, k) = all[1] - all[0];
    open[k] = spans(box, k) || (!bounded_[k] && !box.periodic[k]);
  }
  return FieldCells::blocks(corner, edges, numbers_, open);
}

void FieldSettings::fix_radii(const BoxState &box) {
  if (!are_rings() || has_radii_) return;
  has_radii_ = true;
  radii_ = {{0.0, HUGE_VAL}};
  for (int k = 0; k < 3; k++) {
    if (k == about_) continue;
    const Bounds all = extent(box, k);
    radii_[1] = std::min({radii_[1], centre_[k] - all[0], all[1] - centre_[k]});
  }
}

FieldCells FieldSettings::rings(const BoxState &box) const {
  const bool open = spans(box, about_) || (!bounded_[about_] && !box.periodic[about_]);
  return FieldCells::rings(about_, centre_, radii_, extent(box, about_), numbers_, open);
}

std::array<bool, 3> FieldSettings::wraps(const BoxState &box) const {
  std::array<bool, 3> wraps{{false, false, false}};
  for (int k = 0; k < 3; k++) {
    const int axis = are_rings() ? about_ : k;  // of the box
    wraps[k] = spans(box, axis) && !(are_rings() && k != 2);
    if (frame_ == Frame::box) continue;
    for (int other = 0; other < 3; other++)  // an edge that leans: cells of its other end stand elsewhere
      if (other != axis && (are_rings() || numbers_[other] > 1)) wraps[k] = wraps[k] && box.edges(other, axis) == 0.0;
  }
  return wraps;
}

Matrix3d FieldSettings::jumps(const BoxState &box) const {
  if (!are_rings()) return box.edge_velocities;
  return Vector3d(0.0, 0.0, box.edge_velocities(about_, about_)).asDiagonal();
}

}

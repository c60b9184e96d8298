// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SCOPE_H
#define GRAINSCOPE_SCOPE_H

#include "number_source.h"
#include "plane.h"
#include "pointers.h"
#include "region_solid.h"
#include <memory>
#include <string>
#include <vector>

namespace grainscope {

class Arguments;

/** Contacts with walls, as the keyword `walls` chooses them. */
enum class Walls { no, yes, only };

/** A pair of atom types, 0 for any; a wall has the type of its material. */
struct TypePair {
  int a = 0, b = 0;

  bool any() const { return a == 0 && b == 0; }
  bool has(int i, int j) const { return (is(a, i) && is(b, j)) || (is(a, j) && is(b, i)); }

 private:
  static bool is(int wanted, int type) { return wanted == 0 || wanted == type; }
};

/** Which of a body's axes stands for its orientation. */
enum class AxisChoice { symmetry, longest, shortest };

/** What a measure covers besides its group: keywords with one meaning in all measures, read in one place.
 *
 *    region ID        the part in a region of LIGGGHTS, which may move
 *    types a b        contacts of atom types a and b, each a number or *
 *    rows types       besides the totals, an array with a row for each pair of types
 *    walls no|yes|only
 *    volume auto|V|v_name   by which stresses and densities are divided: of the region or the box,
 *                           an area in two dimensions
 *    plane xy|xz|yz   flow and gradient
 *    pressure x|y|z|mean    -sigma_aa or -tr sigma/dimension; default: a is the gradient of the plane
 *    axis auto|symmetry|long|short */
class Scope : private LAMMPS_NS::Pointers {
 public:
  /** Keywords that a measure understands. */
  enum Keywords : unsigned {
    types = 1,
    rows = 2,
    walls = 4,
    volume = 8,
    plane = 16,
    pressure = 32,
    axis = 64,
    region = 128
  };

  /** `style` for messages. */
  Scope(LAMMPS_NS::LAMMPS *lmp, const std::string &style, unsigned keywords);

  /** The measure's own keywords with those that it shares. */
  std::vector<std::string> with(std::vector<std::string> own) const;
  /** Reads what follows `keyword` when it is a shared one. */
  bool read(Arguments &arguments, const std::string &keyword);
  /** Before each run: errors if a type or a variable does not exist; a warning, once, if stresses are divided by the
   *  volume of a box that grains may not fill, by default. */
  void init();

  /** Before use in a step: a region may move. Collective. */
  void update(const BoxState &box) {
    if (region_) region_->update(box);
  }

  /** The region, null for everywhere. */
  const RegionSolid *within() const { return region_.get(); }
  bool has_place(const Eigen::Vector3d &x) const { return !region_ || region_->has(x); }
  const TypePair &type_pair() const { return types_; }
  bool by_types() const { return by_types_; }
  Walls chosen_walls() const { return walls_; }
  void choose_walls(Walls which) { walls_ = which; }
  const Plane &shear_plane() const { return plane_; }
  AxisChoice axis_choice() const { return axis_; }
  /** No axis was given: a group with both long and flat grains gets a warning. */
  bool axis_is_automatic() const { return axis_is_automatic_; }
  /** The volume by which stresses and densities are divided, after update(). Collective. */
  double volume_now(const BoxState &box) const;
  /** -sigma_aa, or -tr sigma/dimension, tension positive. */
  template <class Tensor>
  double pressure_of(const Tensor &stress, int dimension) const {
    if (pressure_ == mean) return -stress.trace() / dimension;
    const int a = pressure_ == of_gradient ? plane_.gradient : pressure_;
    return -stress(a, a);
  }

 private:
  enum { of_gradient = -2, mean = -1 };  // or an axis, 0 to 2

  std::string style_;
  unsigned keywords_;
  std::unique_ptr<RegionSolid> region_;
  TypePair types_;
  bool by_types_ = false;
  Walls walls_ = Walls::yes;
  Plane plane_;
  int pressure_ = of_gradient;
  AxisChoice axis_ = AxisChoice::symmetry;
  bool axis_is_automatic_ = true;
  bool volume_given_ = false;
  bool warned_ = false;
  NumberSource volume_;

  void read_types(Arguments &arguments);
  void read_volume(Arguments &arguments);
  void read_axis(Arguments &arguments);
  void warn_of_whole_box();
  void init_region();
  double volume_of_region() const;
};

}

#endif

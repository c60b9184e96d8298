// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_REGION_SOLID_H
#define GRAINSCOPE_REGION_SOLID_H

#include "box_state.h"
#include "pointers.h"
#include "solid.h"
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class Region;
}

namespace grainscope {

/** A region of LIGGGHTS: what is inside, by the rule of LIGGGHTS, and its shape as far as it is known, at its place in
 *  the step. A region that extends beyond a periodic box ends at its faces. */
class RegionSolid : private LAMMPS_NS::Pointers {
 public:
  /** `style` for messages. An error when there is no region of that ID. */
  RegionSolid(LAMMPS_NS::LAMMPS *lmp, const std::string &style, const std::string &id);

  const std::string &id() const { return id_; }
  /** Before each run: finds it again. */
  void init();
  /** Before use in a step: where it is now. The host does not set up every run (`run pre no`), and between runs the ID
   *  may become another region's: it is found again. Collective. */
  void update(const BoxState &box);

  bool has(const Eigen::Vector3d &x) const;
  /** The share of a line that lies inside, from 0 to 1; of a line across periodic faces each part where it belongs. */
  double part(const Eigen::Vector3d &from, const Eigen::Vector3d &to) const;
  /** From now on an error, whenever the region is found again, if the shape by which lines are cut is not known. */
  void require_parts();
  /** The volume of the part inside the box, in two dimensions the area in the plane of the grains. False, with the
   *  reason, if it is not known; an error if there is none. */
  bool volume(double &value, std::string &why) const;

 private:
  std::string style_, id_;
  LAMMPS_NS::Region *region_ = nullptr;
  LAMMPS_NS::bigint first_step_ = -1;  // of the run in which it was found
  BoxState box_;
  bool needs_parts_ = false;
  bool known_ = false;   // the shape
  bool new_run_ = true;  // not yet updated in it
  std::string why_not_;
  Solid solid_ = Solid::common({});
  double height_ = 0.0;  // z of the plane of two dimensions

  LAMMPS_NS::Region *find(const std::string &id) const;
  void require_known(bool known, const std::string &why) const;
  void require_sound(LAMMPS_NS::Region *region) const;
  bool volume_within(double beyond, double &value, std::string &why) const;
  bool follows_grains(int k, int side) const;
  void evaluate(LAMMPS_NS::Region *region) const;
  double height_of_grains() const;
};

}

#endif

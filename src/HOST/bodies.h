// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_BODIES_H
#define GRAINSCOPE_BODIES_H

#include "box_state.h"
#include "pointers.h"
#include <string>
#include <vector>

namespace LAMMPS_NS {
class FixMultisphere;
}

namespace grainscope {

class Arguments;

/** A clump: a rigid body that is made of spheres. */
struct Body {
  int tag = 0;       // of the host
  int first_id = 0;  // the lowest ID of its spheres
  double spheres = 0.0;
  double mass = 0.0, volume = 0.0;
  Eigen::Vector3d centre, velocity, spin;  // of mass; the centre in one of its periodic images
  Eigen::Vector3d boxes;                   // image flags of the centre
  Eigen::Vector3d inertia;                 // about its principal axes
  Eigen::Matrix3d axes;                    // these, unit, in columns

  /** 1/2 w.J w, w in the laboratory frame. */
  double rotational_energy(const Eigen::Vector3d &w) const {
    return 0.5 * (axes.transpose() * w).cwiseAbs2().dot(inertia);
  }
};

/** The clumps of LIGGGHTS's fix multisphere: for every sphere the body that it is part of. Each clump counts as one
 *  grain, represented by its sphere with the lowest ID: the rank, group and memory of the clump are those of this
 *  sphere. Without clumps nothing is done. */
class Bodies : private LAMMPS_NS::Pointers {
 public:
  /** Finds the fix; errors in the name of `style` for two of them and for fix rigid, whose bodies are not known. */
  Bodies(LAMMPS_NS::LAMMPS *lmp, const std::string &style);

  bool any() const { return fix_; }
  /** All bodies in their present state, on all ranks. Errors if the group has some spheres of a clump but not all, and
   *  if a clump is larger than half the box along a periodic edge. Collective. */
  void update(const BoxState &box, int groupbit);
  /** Errors if clumps may break, for measures that follow a clump by the sphere that represents it. */
  void require_lasting() const;

  /** Of local grain or ghost i: null where it is on its own. */
  const Body *of(int i) const;
  /** Local grain i is on its own, or stands for its clump. */
  bool stands_for_itself_or_clump(int i) const;
  /** From the centre of mass of its body, in the image that it belongs to, to the centre of i; zero on its own. */
  Eigen::Vector3d arm(int i) const;

 private:
  std::string style_;
  LAMMPS_NS::FixMultisphere *fix_ = nullptr;
  BoxState box_;
  std::vector<Body> all_;
  std::vector<int> place_;  // in all_, by tag; -1 where there is none

  void gather(std::vector<double> &numbers) const;
  void find_first_ids();
  void require_whole(int groupbit) const;
  void require_small() const;
};

/** Before a run, for what finds the bodies later: the same errors as of their constructor. */
void require_known_bodies(LAMMPS_NS::LAMMPS *lmp, const std::string &style);
/** Fix multisphere or rigid. */
bool has_bodies(LAMMPS_NS::LAMMPS *lmp);
/** An error if there are clumps; `why` says what they would do to the measure. In init(). */
void require_no_bodies(LAMMPS_NS::LAMMPS *lmp, const Arguments &errors, const std::string &why);

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PAIR_CHECKS_H
#define GRAINSCOPE_PAIR_CHECKS_H

#include "pointers.h"
#include <initializer_list>
#include <string>

namespace grainscope {

/** The checks of pair_style gran/insitu before a run or at a new neighbour list, for conditions that LIGGGHTS does not
 *  check. All are collective. */
class PairChecks : private LAMMPS_NS::Pointers {
 public:
  explicit PairChecks(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  /** A setting that adds columns to the contact history. */
  struct ColumnSetting {
    const char *keyword, *with, *without;
    int columns;
    bool on;
  };
  /** The restart file that is to be continued must hold `wanted` numbers per contact, those of `settings` among
   * them. */
  void require_same_columns_in_restart(int wanted, std::initializer_list<ColumnSetting> settings) const;
  /** A warning of what the restart file holds for walls, fixes and computes that have another ID now. */
  void warn_of_lost_states();
  /** The contact history is kept by grain ID: if two images of one grain are within reach of another grain it is
   *  ambiguous. */
  void require_box_large_enough() const;
  /** Contact laws have no factors between pressures and forces. */
  void require_consistent_units() const;
  /** With `dimension 2`: spheres in one plane across z, with no motion out of it. */
  void require_grains_in_plane() const;
  /** A warning, once, if spheres keep the tangential springs of contacts that have opened. */
  void warn_of_stale_springs();
  /** A warning of walls whose contacts are not measured: once, and again when there are others. */
  void warn_of_unseen_walls();
  /** A warning, once, if `model`, which takes its geometry from spheres, is used with other grains; "": no such model.
   */
  void warn_of_sphere_model(const std::string &model);

 private:
  std::string warned_of_walls_;  // by their IDs
  bool warned_of_stale_springs_ = false;
  bool warned_of_sphere_model_ = false;
};

}

#endif

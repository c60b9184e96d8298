// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_GRAIN_ORDER_H
#define GRAINSCOPE_GRAIN_ORDER_H

#include "pointers.h"

namespace grainscope {

/** The order of the grains of a rank, in which forces are summed. LIGGGHTS sorts grains by position at intervals of
 *  steps, and when a run begins. */
class GrainOrder : private LAMMPS_NS::Pointers {
 public:
  explicit GrainOrder(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}
  ~GrainOrder() override { allow_sorting(); }
  GrainOrder(const GrainOrder &) = delete;
  GrainOrder &operator=(const GrainOrder &) = delete;

  void prevent_sorting();
  void allow_sorting();
  /** In the order of their IDs: the only one that a run and its resumption have in common. */
  void sort_by_id();

 private:
  int sort_every_ = 0;  // the host's number, while it is not to sort
};

}

#endif

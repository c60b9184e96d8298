// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_LAST_EVALUATION_H
#define GRAINSCOPE_LAST_EVALUATION_H

#include "evaluation_memory.h"
#include "grain_memory.h"
#include "pointers.h"

namespace grainscope {

/** The last force evaluation, and its repetition when a run begins, with its box, positions and velocities. Afterwards
 *  grains get back the positions and forces that they had at the end of the last run. */
class LastEvaluation : public EvaluationMemory, private LAMMPS_NS::Pointers {
 public:
  explicit LastEvaluation(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp), grains(lmp) {}

  GrainMemory grains;

  bool repeats() const override { return repeats_; }
  void swap() override;
  double stamp() const override { return stamp_; }
  void set_stamp(double stamp) override { stamp_ = stamp; }

  const HostBox &box() const { return box_; }
  void set_box(const HostBox &box) { box_ = box; }
  void note();
  void begin_repetition();
  void end_repetition();
  void give_up_repetition() { repeats_ = false; }
  /** Wraps the grains that the box has moved past, and what is remembered of them; others keep their bits. */
  void wrap_grains();

 private:
  HostBox box_;
  double stamp_ = 0.0;
  bool repeats_ = false;
};

}

#endif

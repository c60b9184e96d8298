// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_EVALUATION_MEMORY_H
#define GRAINSCOPE_EVALUATION_MEMORY_H

#include <memory>

namespace grainscope {

/** The last force evaluation, as `setup neutral` remembers it: what the pair style needs to repeat it when a run
 *  begins. */
class EvaluationMemory {
 public:
  virtual ~EvaluationMemory() = default;

  /** Whether the evaluation under way repeats the last one. */
  virtual bool repeats() const = 0;
  /** Exchanges box, positions and velocities with those of the last evaluation, ghosts included; a second time,
   *  back. */
  virtual void swap() = 0;
  /** Of the last evaluation; see ContactObserver. */
  virtual double stamp() const = 0;
  virtual void set_stamp(double stamp) = 0;
  /** Not so after a first evaluation of a run. */
  bool repeats_a_step() const { return repeats() && stamp() > 0.0; }
};

/** The fix that keeps one. */
class KeepsEvaluation {
 public:
  virtual ~KeepsEvaluation() = default;
  virtual std::weak_ptr<EvaluationMemory> evaluation() = 0;
};

}

#endif

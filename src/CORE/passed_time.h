// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PASSED_TIME_H
#define GRAINSCOPE_PASSED_TIME_H

namespace grainscope {

/** The time that has passed in a run whose time step may change and whose steps may be renumbered. The time of LIGGGHTS
 *  is not in restart files, and `reset_timestep` changes it. While the time step stays the same, steps are counted and
 *  not summed. */
class PassedTime {
 public:
  /** In restart files: the time before steps of length dt, and how many of these. */
  struct State {
    double before, steps, dt;
  };

  PassedTime(double step, double dt) : step_(step), dt_(dt) {}

  /** At a step; steps are whole numbers. */
  double at(double step) const { return before_ + (step - step_) * dt_; }
  /** Steps after `last` have the length dt. */
  void set_length(double dt, double last) {
    if (dt == dt_) return;
    before_ = at(last);
    step_ = last;
    dt_ = dt;
  }
  /** Step `before` is called `now`, and no time passes. */
  void renumber(double now, double before) { step_ += now - before; }
  State state(double step) const { return {before_, step - step_, dt_}; }
  void restore(const State &state, double step) {
    before_ = state.before;
    step_ = step - state.steps;
    dt_ = state.dt;
  }

 private:
  double before_ = 0.0;  // what had passed at step_
  double step_;
  double dt_;
};

}

#endif

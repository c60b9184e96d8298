// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_TIME_STEP_WATCH_H
#define GRAINSCOPE_TIME_STEP_WATCH_H

#include "contact_sink.h"
#include "time_step_bound.h"
#include "lmptype.h"
#include "pointers.h"
#include <vector>

namespace grainscope {

/** Checks every 1000 steps, counted across runs, whether the time step is short enough for the present contacts. A
 *  warning gives the value, the limit and a safe time step; the next warning comes only when the value has doubled.
 *  Single contacts are checked first; if one comes near the limit, whole grains are checked in the next step. */
class TimeStepWatch : public ContactSink, private LAMMPS_NS::Pointers {
 public:
  explicit TimeStepWatch(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  void begin_run();
  bool wants_contacts() override;
  void begin_contacts() override;
  void add_contacts(ContactSpan contacts) override;
  void end_contacts() override;

 private:
  enum class Level { none, contacts, grains } level_ = Level::none;
  double warned_of_ = 0.0;    // the value of b
  bool clumps_ = false;       // whose masses are not those of their spheres: nothing is checked
  int steps_ = 0;             // since the last check
  bool grains_next_ = false;  // the next look is at grains
  double largest_ = 0.0;      // of this rank's contacts
  int damped_ = 0;            // one of them has tangential damping
  std::vector<time_step::GrainModes> grains_;

  void evaluate_contacts();
  void evaluate_grains();
};

}

#endif

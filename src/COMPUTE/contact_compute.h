// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_COMPUTE_H
#define GRAINSCOPE_CONTACT_COMPUTE_H

#include "compute.h"
#include "contact_sink.h"
#include <string>

namespace grainscope {

class ContactObserver;

/** A compute that sees contacts: it listens to the force evaluations of the steps it is announced for, as LAMMPS announces
 *  computes (thermo, fix ave/time, dumps and variables in them do), and of the last step of every run; it refuses to answer for any other.
 *  What it gives as a whole or as rows is computed when a run ends, so that the input script can ask for it until the next run begins. */
class ContactCompute : public LAMMPS_NS::Compute, public ContactSink {
 public:
  ContactCompute(LAMMPS_NS::LAMMPS *lmp, int &iarg, int narg, char **arg);

  void init() override;
  bool wants_contacts() override;
  void end_run() override;

 protected:
  ContactObserver *observer_;
  std::string name_;  // "compute <style>", for messages

  bool both_in_group(int i, int j) const;
  bool in_group(int i) const;
  /** Errors unless the damping and friction of the contact model are known: their powers are to be told. In init(). */
  void require_known_losses() const;
  /** Errors unless the current step was tallied. */
  void require_tally() const;
  /** Whether the answer of this step, given at `answered` of update->ntimestep, was kept when the run ended: what moves
   *  grains since then is not of the contacts. */
  bool kept_since_run(LAMMPS_NS::bigint answered) const;
  /** False where an answer that nobody asked for may end the run. */
  virtual bool answers_after_run() const { return true; }
  /** Nobody has asked yet: no warnings. */
  bool unasked() const { return unasked_; }
  /** Errors unless `contacts`, the number over all ranks of those whose place or direction is not finite, is 0. */
  void require_finite(double contacts) const;
  /** Sums `values` over all ranks, in place. */
  void sum_over_ranks(double *values, int n) const;

 private:
  LAMMPS_NS::bigint tallied_;
  bool unasked_;
  bool run_over_ = false;  // since the last tally
};

}

#endif

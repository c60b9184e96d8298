// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(run/guard,FixRunGuard)

#else

#ifndef LMP_FIX_RUN_GUARD_H
#define LMP_FIX_RUN_GUARD_H

#include "internal_fix.h"
#include <memory>
#include <string>

namespace LAMMPS_NS {

/** Guards every run with pair_style gran/insitu. It ends the run at numbers that are not finite, at grains lost from a
 *  periodic box and at output that cannot be written; warns of a first evaluation that exceeds the friction limit; ends
 *  the run in order at a signal; seals restart files, with the words of the pair style in them. Made by the pair style,
 *  with its words as the argument, not by input scripts. */
class FixRunGuard : public grainscope::InternalFix {
 public:
  FixRunGuard(class LAMMPS *lmp, int narg, char **arg);
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override { pre_exchange(); }
  void setup_pre_neighbor() override { pre_neighbor(); }
  void setup(int) override;
  void pre_exchange() override;
  void pre_neighbor() override;
  void end_of_step() override;
  void post_run() override;
  void write_restart(FILE *file) override;
  void restart(char *buffer) override;
  void write_restart_file(char *file) override;

 protected:
  std::shared_ptr<void> state() override { return warned_of_damping_; }
  void take_state(const std::shared_ptr<void> &state) override {
    warned_of_damping_ = std::static_pointer_cast<bool>(state);
  }

 private:
  std::string settings_;                     // the words of the pair style
  std::shared_ptr<bool> warned_of_damping_;  // since there is a pair style of ours
  bool running_ = false;
  bigint grains_ = 0;  // on this rank, before they are dealt out to the ranks

  /** What is wrong on this rank, or "". */
  std::string not_finite(bool forces) const;
  std::string not_written() const;
  void warn_of_damping();
  /** Ends the run when anything is wrong on any rank; collective. */
  void fail_on_all_ranks(const std::string &trouble) const;
};

}

#endif
#endif

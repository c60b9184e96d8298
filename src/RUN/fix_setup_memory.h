// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(setup/memory,FixSetupMemory)

#else

#ifndef LMP_FIX_SETUP_MEMORY_H
#define LMP_FIX_SETUP_MEMORY_H

#include "evaluation_memory.h"
#include "internal_fix.h"
#include <memory>

namespace LAMMPS_NS {

/** The memory of `setup neutral` of pair_style gran/insitu: the last force evaluation and the state at the end of the
 *  run. At the start of each run LIGGGHTS recomputes all forces with full-step velocities, unlike an uninterrupted run.
 *  With this fix contacts are evaluated with the velocities of their step, and grains get back their forces and
 *  positions. Kept in restart files. Made by the pair style, not by input scripts. */
class FixSetupMemory : public grainscope::InternalFix, public grainscope::KeepsEvaluation {
 public:
  FixSetupMemory(class LAMMPS *lmp, int narg, char **arg);
  ~FixSetupMemory() override;
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup_pre_force(int) override;
  void setup(int) override;
  void pre_exchange() override;
  void pre_force(int) override;
  void post_run() override;

  std::weak_ptr<grainscope::EvaluationMemory> evaluation() override;

  double memory_usage() override;
  void grow_arrays(int nmax) override;
  void copy_arrays(int from, int to, int) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double *buffer) override;
  int unpack_exchange(int i, double *buffer) override;
  int pack_restart(int i, double *buffer) override;
  void unpack_restart(int i, int nth) override;
  int size_restart(int) override;
  int maxsize_restart() override;
  void write_restart(FILE *file) override;
  void restart(char *buffer) override;

 protected:
  std::shared_ptr<void> state() override;
  void take_state(const std::shared_ptr<void> &state) override;

 private:
  struct Memory;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}

#endif
#endif

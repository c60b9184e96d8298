// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(setup/memory,FixSetupMemory)

#else

#ifndef LMP_FIX_SETUP_MEMORY_H
#define LMP_FIX_SETUP_MEMORY_H

#include "fix.h"
#include <vector>

namespace LAMMPS_NS {

/** What `setup neutral` of pair_style gran/insitu remembers: of every grain the velocities that its last forces were formed with, those forces, and
 *  where it was. The host evaluates all forces anew when a run begins, with other velocities than a run that goes on would have; with
 *  this, contacts are evaluated with the velocities of their step, and grains get back the forces and places that they had. In restart
 *  files.
 *  Made by the pair style, not by input scripts. */
class FixSetupMemory : public Fix {
 public:
  FixSetupMemory(class LAMMPS *lmp, int narg, char **arg);
  ~FixSetupMemory();
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup_pre_force(int) override;
  void setup(int) override;
  void pre_exchange() override;
  void pre_force(int) override;
  void post_run() override;

  /** Makes it, or moves it behind all other fixes, so that its `setup` has the last word; collective. */
  static FixSetupMemory *make(class LAMMPS *lmp);
  /** Where a pointer to it is kept, which ends with it. */
  void kept_at(FixSetupMemory **place) { place_ = place; }
  static void forget(class LAMMPS *lmp);

  /** Whether the evaluation under way repeats the last one. */
  bool again() const { return again_; }
  /** Box, places and velocities of the last evaluation in, or what they were before out again; ghosts follow. */
  void swap_evaluation();
  /** Of the last evaluation; see ContactObserver. */
  double stamp() const { return shared_.stamp; }
  void set_stamp(double stamp) { shared_.stamp = stamp; }

  double memory_usage() override { return values_.capacity() * sizeof(double); }
  void grow_arrays(int nmax) override;
  void copy_arrays(int from, int to, int) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double *buffer) override;
  int unpack_exchange(int i, double *buffer) override;
  int pack_restart(int i, double *buffer) override;
  void unpack_restart(int i, int nth) override;
  int size_restart(int) override { return width + 1; }
  int maxsize_restart() override { return width + 1; }
  void write_restart(FILE *file) override;
  void restart(char *buffer) override;

 private:
  // Numbers of a grain: whether there are any; place and velocities at the evaluation; force and torque; place and image at the end of its step; the
  // rest of its state, hashed.
  enum {
    known, half_x, half_v = half_x + 3, half_omega = half_v + 3, f = half_omega + 3, torque = f + 3, x = torque + 3, image = x + 3, velocity_hash,
    state_hash, width
  };
  /** The box and its rates. */
  struct Box {
    double low[3] = {}, high[3] = {}, tilts[3] = {}, rates[6] = {}, low_rates[3] = {};
  };
  struct Shared {
    Box evaluated, ended;        // at the last evaluation, and at the end of its step
    double grains = -1.0;        // there were, or -1 before the first run
    double dt = 0.0;
    double stamp = 0.0;
    double to_sort = 0.0;        // steps until the host sorts grains by place
    double movers = 0.0;         // checksum of the fixes that push or move grains
  };

  std::vector<double> values_;
  Shared shared_;
  bool running_ = false;
  bool again_ = false;
  FixSetupMemory **place_ = nullptr;
  int sort_every_ = 0;           // what the host was told, while it is not to sort

  double *of(int i) { return &values_[static_cast<std::size_t>(i) * width]; }
  const double *of(int i) const { return &values_[static_cast<std::size_t>(i) * width]; }
  void allow_sorting();
  void sort_by_tag();
  void take_rest();
  void carry_across(int i, tagint image_before);
  void wrap_now();
  bool unchanged() const;
  bool same(int i) const;
  bool same_box() const;
  double movers_now() const;
  Box box_now() const;
  void set_box(const Box &box);
};

}

#endif
#endif

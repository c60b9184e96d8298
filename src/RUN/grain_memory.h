// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_GRAIN_MEMORY_H
#define GRAINSCOPE_GRAIN_MEMORY_H

#include "host_box.h"
#include "lmptype.h"
#include "pointers.h"
#include <vector>

namespace grainscope {

/** What `setup neutral` remembers of a grain, in restart files too: numbers, all doubles. */
struct RememberedGrain {
  double known;                              // 1 once there is anything
  double position[3], velocity[3], spin[3];  // at the last force evaluation
  double force[3], torque[3];                // of that evaluation
  double end_position[3];                    // at the end of its step
  double end_image;                          // the bits of the image flag, then
  double velocity_hash, state_hash;          // then; see grain_state.h
};

/** The remembered grains of this rank, in the host's order. */
class GrainMemory : private LAMMPS_NS::Pointers {
 public:
  static constexpr int width = sizeof(RememberedGrain) / sizeof(double);

  explicit GrainMemory(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  void resize(int n) { grains_.resize(n, RememberedGrain{}); }
  double bytes() const { return grains_.capacity() * sizeof(RememberedGrain); }
  void copy(int from, int to) { grains_[to] = grains_[from]; }
  void clear(int i) { grains_[i] = RememberedGrain{}; }
  /** `width` numbers. */
  void write(int i, double *numbers) const;
  void read(int i, const double *numbers);

  void note_evaluation();
  void note_end_of_step();
  /** Exchanges positions, velocities and spins with those of the last evaluation. */
  void swap_evaluation();
  /** Gives grains the positions that they ended the step with; `box`: of the evaluation, for grains that were
   *  wrapped since. */
  void restore_positions(const HostBox &box);
  void restore_forces() const;
  /** Grain i was wrapped since the last evaluation: changes the position and velocity that are remembered of it. */
  void wrap(int i, LAMMPS_NS::tagint image_before, const HostBox &box);
  /** Whether grain i is as it was at the end of its step, but for wrapping. */
  bool unchanged(int i) const;

 private:
  std::vector<RememberedGrain> grains_;
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(grain/record,FixGrainRecord)

#else

#ifndef LMP_FIX_GRAIN_RECORD_H
#define LMP_FIX_GRAIN_RECORD_H

#include "internal_fix.h"
#include "passed_time.h"
#include <string>
#include <vector>

namespace LAMMPS_NS {

/** The memory of a compute: `width` numbers per grain, which follow the grain from rank to rank, and numbers that all
 *  ranks share; both are in restart files. New grains have zeros. It also notes the box of each force evaluation, to
 *  which image flags refer (a fix that deforms the box at the end of the step does so before computes are evaluated),
 *  counts box flips, and knows the time that has passed. Made by computes, not by input scripts: its arguments are
 *  width, shared size, and a number that identifies what is remembered. */
class FixGrainRecord : public grainscope::InternalFix {
 public:
  FixGrainRecord(class LAMMPS *lmp, int narg, char **arg);
  ~FixGrainRecord() override;
  int setmask() override;
  void reset_timestep(bigint now, bigint before) override;
  void setup_pre_force(int) override;
  void pre_force(int) override;

  /** Makes the record of compute `id`, in its constructor; what a restart file holds of it is restored, and refused
   *  when `meaning` (style and keywords of the compute) was another. `step_at`: where the shared numbers hold a step,
   *  which `reset_timestep` renumbers. Collective. */
  static FixGrainRecord *make(class LAMMPS *lmp, const char *id, int igroup, int width, int shared,
                              const std::string &meaning, int step_at = -1);
  /** The record that was made, or an error when it is gone. */
  static FixGrainRecord *find(class LAMMPS *lmp, const char *id);
  /** To be called by the compute's destructor. */
  static void forget(class LAMMPS *lmp, const char *id);

  double *of(int grain) { return &values_[static_cast<std::size_t>(grain) * width_]; }
  std::vector<double> &shared() { return shared_; }
  /** Since the compute was defined, before restarts too. */
  double passed_time() const;
  /** Edges (upper triangle: xx yy zz yz xz xy) of the box at the last force evaluation. */
  const double *edges() const { return edges_; }
  /** How often the box was flipped since this was asked last, by the tilts yz, xz, xy: in edges, positive where the
   *  tilt grew. */
  void take_box_flips(double flips[3]);
  /** The box was changed between runs, which is no flip: image flags now count the edges of this one. */
  void note_changed_box();

  double memory_usage() override;
  void grow_arrays(int nmax) override;
  void copy_arrays(int from, int to, int delflag) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double *buffer) override;
  int unpack_exchange(int i, double *buffer) override;
  int pack_restart(int i, double *buffer) override;
  void unpack_restart(int i, int nth) override;
  int size_restart(int) override { return width_ + 1; }
  int maxsize_restart() override { return width_ + 1; }
  void write_restart(FILE *file) override;
  void restart(char *buffer) override;

 private:
  int width_;
  std::vector<double> values_, shared_;
  double meaning_;
  grainscope::PassedTime time_;
  int step_at_ = -1;
  double edges_[6];
  double flips_[3] = {0.0, 0.0, 0.0};

  void note_box();
  void require_room() const;
};

}

#endif
#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(grain/record,FixGrainRecord)

#else

#ifndef LMP_FIX_GRAIN_RECORD_H
#define LMP_FIX_GRAIN_RECORD_H

#include "fix.h"
#include <string>
#include <vector>

namespace LAMMPS_NS {

/** The memory of a compute: `width` numbers per grain, which follow the grain from rank to rank, and numbers that all ranks share; both
 *  are kept in restart files. New grains have zeros. It also notes the box of each force evaluation, the one that image flags count in:
 *  a fix that deforms the box at the end of the step moves it on before computes are asked.
 *  Made by computes, not by input scripts: arguments are width and shared size. */
class FixGrainRecord : public Fix {
 public:
  FixGrainRecord(class LAMMPS *lmp, int narg, char **arg);
  ~FixGrainRecord();
  int setmask();
  void setup_pre_force(int) { note_box(); }
  void pre_force(int) { note_box(); }

  /** The record of compute `id`, made if there is none; what a restart file holds of it is restored. Collective. */
  static FixGrainRecord *of_compute(class LAMMPS *lmp, const char *id, int igroup, int width, int shared);
  /** To be called by the compute's destructor. */
  static void forget(class LAMMPS *lmp, const char *id);

  double *of(int grain) { return &values_[static_cast<std::size_t>(grain) * width_]; }
  std::vector<double> &shared() { return shared_; }
  /** Edges (upper triangle: xx yy zz yz xz xy) of the box at the last force evaluation. */
  const double *edges() const { return edges_; }

  double memory_usage();
  void grow_arrays(int nmax);
  void copy_arrays(int from, int to, int delflag);
  void set_arrays(int i);
  int pack_exchange(int i, double *buffer);
  int unpack_exchange(int i, double *buffer);
  int pack_restart(int i, double *buffer);
  void unpack_restart(int i, int nth);
  int size_restart(int) { return width_ + 1; }
  int maxsize_restart() { return width_ + 1; }
  void write_restart(FILE *file);
  void restart(char *buffer);

 private:
  int width_;
  std::vector<double> values_, shared_;
  double edges_[6];

  void note_box();
  static std::string id_for(const char *compute);
  void require_size(int found, int expected) const;
};

}

#endif
#endif

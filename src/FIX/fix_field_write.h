// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(field/write,FixFieldWrite)

#else

#ifndef LMP_FIX_FIELD_WRITE_H
#define LMP_FIX_FIELD_WRITE_H

#include "fix.h"
#include "field_source.h"
#include <string>
#include <vector>

namespace grainscope {
struct FieldTable;
}

namespace LAMMPS_NS {

/** Writes a compute field, averaged over samples in time, to files for pandas (csv) and ParaView (vti, vts). Means are
 *  ratios of sums, their errors those of the jackknife over blocks of samples. Rank 0 writes. */
class FixFieldWrite : public Fix {
 public:
  FixFieldWrite(class LAMMPS *lmp, int narg, char **arg);
  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void end_of_step() override;
  void reset_timestep(bigint now) override;
  double memory_usage() override;

 private:
  bigint repeats_ = 1, frequency_ = 1;  // nevery is the host's
  std::string compute_id_;
  std::vector<std::string> files_;
  int blocks_ = 0;  // 0: no errors

  class Compute *compute_ = nullptr;
  grainscope::FieldSource *source_ = nullptr;
  long source_number_ = 0;
  bigint next_ = -1;                             // sample
  bigint taken_ = 0;                             // samples since the last file
  std::vector<grainscope::FieldSums> averaged_;  // of each block, or of all; on rank 0

  bool find_source();
  void begin_window();
  bigint next_sample(bigint after) const;
  void add_sample();
  grainscope::FieldTable table() const;
  std::vector<double> rows(const grainscope::FieldSums &all) const;
  std::vector<double> errors(const grainscope::FieldSums &all, const std::vector<double> &rows) const;
  std::vector<double> row_of(int cell, const grainscope::FieldSums &sums, double samples) const;
  std::string not_writable() const;
  void write_files();
  std::string write(const std::string &pattern, const grainscope::FieldTable &table) const;
  void fail_on_all_ranks(std::string trouble) const;
};

}

#endif
#endif

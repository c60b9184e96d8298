// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(contacthistory,FixContactHistoryEllipsoid)

#else

#ifndef LMP_FIX_CONTACT_HISTORY_ELLIPSOID_H
#define LMP_FIX_CONTACT_HISTORY_ELLIPSOID_H

#include "fix_contact_history.h"

namespace LAMMPS_NS {

/** The contact history of LIGGGHTS, whose restart data have the columns of `surface superquadric` also when `surface
 *  ellipsoid` keeps only one of them; the others are 0. So each surface reads what the other wrote. Data with the same
 *  number of columns but other meanings are refused. */
class FixContactHistoryEllipsoid : public FixContactHistory {
 public:
  using FixContactHistory::FixContactHistory;
  void write_restart(FILE *file) override;
  void restart(char *buffer) override;
  int pack_restart(int i, double *buffer) override;
  void unpack_restart(int i, int nth) override;
  int size_restart(int i) override;
  int maxsize_restart() override;

 private:
  /** Columns that restart data have beyond those in memory. */
  int more() const;
  double mark() const;
};

}

#endif
#endif

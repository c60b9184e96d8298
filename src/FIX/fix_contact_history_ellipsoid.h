// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(contacthistory,FixContactHistoryEllipsoid)

#else

#ifndef LMP_FIX_CONTACT_HISTORY_ELLIPSOID_H
#define LMP_FIX_CONTACT_HISTORY_ELLIPSOID_H

#include "fix_contact_history.h"

namespace LAMMPS_NS {

/** The host's contact history, whose restart data have the columns of `surface superquadric` also where `surface
 *  ellipsoid` keeps one of them: 0 stands in those that it leaves out. So either surface reads what the other wrote.
 *  Data of other columns, though as many, are refused. */
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

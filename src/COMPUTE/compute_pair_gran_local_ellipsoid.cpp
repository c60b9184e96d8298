// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_pair_gran_local_ellipsoid.h"
#include "superquadric_columns.h"
#include "pair_gran.h"

using namespace LAMMPS_NS;
using grainscope::SuperquadricColumns;

void ComputePairGranLocalEllipsoid::init_cpgl(bool requestflag) {
  ComputePairGranLocal::init_cpgl(requestflag);
  of_ellipsoids_ = pairgran && pairgran->contact_match("surface", "ellipsoid");
  if (!of_ellipsoids_) return;
  dnum += SuperquadricColumns::left_out;
  if (histflag) size_local_cols = nvalues += SuperquadricColumns::left_out;
}

/** `hist`: the columns that memory holds, and behind them those of `surface superquadric` (ShownRow). */
void ComputePairGranLocalEllipsoid::add_pair(int i, int j, double fx, double fy, double fz, double tor1, double tor2,
                                             double tor3, double *hist, const double *const contact_point) {
  if (of_ellipsoids_) {
    const double *const shown = hist + pairgran->dnum();
    row_.assign(shown, shown + SuperquadricColumns::count);
    row_.insert(row_.end(), hist + 1, hist + pairgran->dnum_pair());
    hist = row_.data();
  }
  ComputePairGranLocal::add_pair(i, j, fx, fy, fz, tor1, tor2, tor3, hist, contact_point);
}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "outside_cell.h"

namespace grainscope {

namespace {

template <class Real>
GRAINSCOPE_INLINE bool all_inside(const CellFrame &cell, const double *places) {
  Real x[3], away[3];
  read_threes(places, x);
  cell.place(x, away);
  return all((absolute(away[0]) <= 0.5) & (absolute(away[1]) <= 0.5) & (absolute(away[2]) <= 0.5));
}

}

GRAINSCOPE_CLONES
int next_outside(const CellFrame &cell, const double *places, int begin, int n) {
  int i = begin;
  while (i + LANES <= n && all_inside<Lanes>(cell, places + 3 * i)) i += LANES;
  while (i < n && all_inside<double>(cell, places + 3 * i)) i++;
  return i;
}

}

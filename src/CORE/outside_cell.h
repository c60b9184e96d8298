// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_OUTSIDE_CELL_H
#define GRAINSCOPE_OUTSIDE_CELL_H

#include "lane_rows.h"

namespace grainscope {

/** Where places lie in a cell: in units of its edges, from its centre on. `inverse`: of the matrix of its edges, which
 *  is upper triangular. */
struct CellFrame {
  double inverse[3][3], centre[3];

  template <class Real>
  GRAINSCOPE_INLINE void place(const Real x[3], Real away[3]) const {
    const Real dx = x[0] - centre[0], dy = x[1] - centre[1], dz = x[2] - centre[2];
    away[0] = inverse[0][0] * dx + inverse[0][1] * dy + inverse[0][2] * dz;
    away[1] = inverse[1][1] * dy + inverse[1][2] * dz;
    away[2] = inverse[2][2] * dz;
  }
};

/** The first of the places `begin` to n - 1 that is not inside the cell, or n. Places: rows of three numbers; what is
 *  no number is outside. */
int next_outside(const CellFrame &cell, const double *places, int begin, int n);

}

#endif

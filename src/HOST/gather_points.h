// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_GATHER_POINTS_H
#define GRAINSCOPE_GATHER_POINTS_H

#include "box_state.h"
#include "pair_correlation.h"
#include <mpi.h>

namespace grainscope {

/** The box as the cell of points, which are all at one z in two dimensions. */
PeriodicCell periodic_cell(const BoxState &box);

/** The points of all ranks, on each, in the order of ranks. Collective. */
PointValues gathered(const PointValues &local, MPI_Comm world);

}

#endif

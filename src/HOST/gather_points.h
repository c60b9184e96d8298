// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_GATHER_POINTS_H
#define GRAINSCOPE_GATHER_POINTS_H

#include "pair_correlation.h"
#include <mpi.h>

namespace grainscope {

/** The points of all ranks, on each, in the order of ranks. Collective. */
PointValues gathered(const PointValues &local, MPI_Comm world);

}

#endif

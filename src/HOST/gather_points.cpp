// SPDX-License-Identifier: GPL-2.0-or-later
#include "gather_points.h"
#include <numeric>
#include <vector>

namespace grainscope {

PeriodicCell periodic_cell(const BoxState &box) {
  PeriodicCell cell{box.edges, box.periodic};
  if (box.dimension == 2) cell.edges(2, 2) = cell.edges(0, 0);  // a layer that is no flatter than it is long
  return cell;
}

PointValues gathered(const PointValues &local, MPI_Comm world) {
  int ranks, n = static_cast<int>(local.size());
  MPI_Comm_size(world, &ranks);
  std::vector<int> counts(ranks), starts(ranks, 0);
  MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  std::partial_sum(counts.begin(), counts.end() - 1, starts.begin() + 1);
  PointValues all(local.sets());
  const auto gather = [&](const std::vector<double> &from, std::vector<double> &to) {
    to.resize(starts.back() + counts.back());
    MPI_Allgatherv(from.data(), n, MPI_DOUBLE, to.data(), counts.data(), starts.data(), MPI_DOUBLE, world);
  };
  for (int k = 0; k < 3; k++) gather(local.s[k], all.s[k]);
  for (int k = 0; k < local.sets(); k++) gather(local.values[k], all.values[k]);
  return all;
}

}

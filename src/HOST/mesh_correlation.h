// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_MESH_CORRELATION_H
#define GRAINSCOPE_MESH_CORRELATION_H

#include "lag_mesh.h"
#include <fftw3-mpi.h>

namespace grainscope {

/** Sums over all pairs of points by Fourier transforms: each point's value, and 1, is given to the mesh cell that holds
 *  it; the autocorrelation of the mesh is the sum over pairs at each lag, whose length stands for the pairs' distances.
 *  Box periodic in all edges, in two dimensions in those of the plane. The ranks share the mesh in slabs.
 * Collective. */
class MeshCorrelation {
 public:
  explicit MeshCorrelation(MPI_Comm world);
  ~MeshCorrelation();
  MeshCorrelation(const MeshCorrelation &) = delete;
  MeshCorrelation &operator=(const MeshCorrelation &) = delete;

  /** The share of the pair sums that this rank's slab holds; `points` are this rank's own; those whose
   *  place is not finite are left out. */
  PairSums pair_sums(const PeriodicCell &cell, const PointValues &points, const DistanceBins &bins,
                     const std::array<int, 3> &size);
  /** On this rank. */
  double memory_usage() const { return numbers_ * sizeof(double); }

 private:
  struct Deposit {
    std::ptrdiff_t cell;  // in the slab of the rank that it is sent to
    double value;
  };

  MPI_Comm world_;
  int ranks_;
  LagMesh mesh_{{{0, 0, 0}}, 0, 0, 0};
  std::ptrdiff_t numbers_ = 0;  // room for the slab and its transform
  std::ptrdiff_t modes_ = 0;    // of the transform on this rank
  double *field_ = nullptr;
  fftw_plan forward_ = nullptr, backward_ = nullptr;
  std::vector<int> owner_;             // rank of each plane
  std::vector<std::ptrdiff_t> first_;  // plane of each rank

  void plan(const std::array<int, 3> &size);
  void clear();
  std::vector<Deposit> slab_deposits(const PointValues &points) const;
  void autocorrelate();
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_MESH_CORRELATION_H
#define GRAINSCOPE_MESH_CORRELATION_H

#include "lag_mesh.h"
#include <array>
#include <memory>
#include <mpi.h>

namespace grainscope {

/** Sums over all pairs of points by Fourier transforms: each point's value, and 1, is given to the mesh cell that holds
 *  it; the autocorrelation of the mesh is the sum over pairs at each lag, whose length stands for the pairs' distances.
 *  Box periodic in all edges, in two dimensions in those of the plane. The ranks share the mesh in slabs.
 * Collective. */
class MeshCorrelation {
 public:
  /** Null in a program that was built without FFTW. */
  static std::unique_ptr<MeshCorrelation> make(MPI_Comm world);
  virtual ~MeshCorrelation() = default;

  /** The share of the pair sums that this rank's slab holds; `points` are this rank's own; those whose
   *  place is not finite are left out. */
  virtual PairSums pair_sums(const PeriodicCell &cell, const PointValues &points, const DistanceBins &bins,
                             const std::array<int, 3> &size) = 0;
  /** On this rank. */
  virtual double memory_usage() const = 0;
};

}

#endif

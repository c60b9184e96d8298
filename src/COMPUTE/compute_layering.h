// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(layering,ComputeLayering)

#else

#ifndef LMP_COMPUTE_LAYERING_H
#define LMP_COMPUTE_LAYERING_H

#include "compute.h"
#include "outputs.h"
#include <memory>

namespace LAMMPS_NS {

/** Correlation of the number density across layers (smectic order), dn = n(y) - n, n = N/V, A = V/L the mean
 *  cross-section: C(y) = A/(n L) int dn(y') dn(y' + y) dy', periodic, for lags y that are multiples of L/layers.
 *  Array: layers/2 + 1 lags. Scalar: largest C beyond lag 0 over C(0), in [-1, 1]. All 0 for an empty group, but
 *  lags.
 *  Source: Bilotto, Trulsson & Molinari 2025, Sec. III A, doi 10.1103/tj41-6qqk; Marschall et al. 2019, doi
 *  10.1103/PhysRevLett.122.188002. */
class ComputeLayering : public Compute, public grainscope::DeclaresOutputs {
 public:
  ComputeLayering(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeLayering() override;
  void init() override;
  double compute_scalar() override;
  void compute_vector() override;
  void compute_array() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}

#endif
#endif

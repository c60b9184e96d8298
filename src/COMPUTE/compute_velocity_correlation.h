// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(velocity/correlation,ComputeVelocityCorrelation)

#else

#ifndef LMP_COMPUTE_VELOCITY_CORRELATION_H
#define LMP_COMPUTE_VELOCITY_CORRELATION_H

#include "compute.h"
#include "outputs.h"
#include <memory>

namespace LAMMPS_NS {

/** Correlation in space of one component of the motion dv of grains against a mean flow, over pairs at their nearest
 *  images: C(r) = (sum over pairs in the bin of dv_i dv_j)/pairs/<dv^2>, in equal bins over [0, range).
 *  Array: bins of r. Scalar: length l of the fit exp(-r/l) to the bins with C > 0.05. Bins that end below the
 *  smallest diameter, and an empty group, give 0.
 *  Source: Bilotto, Trulsson & Molinari 2025, Eq. (7) and Fig. 9, doi 10.1103/tj41-6qqk. */
class ComputeVelocityCorrelation : public Compute, public grainscope::DeclaresOutputs {
 public:
  ComputeVelocityCorrelation(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeVelocityCorrelation() override;
  void init() override;
  double compute_scalar() override;
  void compute_vector() override;
  void compute_array() override;
  double memory_usage() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;

  void measure();
  void report();
};

}

#endif
#endif

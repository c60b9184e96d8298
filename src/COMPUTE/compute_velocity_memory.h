// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(velocity/memory,ComputeVelocityMemory)

#else

#ifndef LMP_COMPUTE_VELOCITY_MEMORY_H
#define LMP_COMPUTE_VELOCITY_MEMORY_H

#include "compute.h"
#include "outputs.h"
#include <memory>

namespace grainscope {
class Fluctuations;
}

namespace LAMMPS_NS {

class FixGrainRecord;

/** How long a grain's velocity fluctuation is remembered: C(lag) = <dv(strain) dv(strain + lag)> / <dv^2>, over
 *  grains and over all samples as origins. A sample is taken when a call finds that the strain has passed another
 *  multiple of `every`. Array: lags + 1 rows. Scalar: strain g of exp(-lag/g), least squares over C > 0.05, 0 when C
 *  does not decay.
 *  Zero for an empty group. Source: Bilotto, Trulsson & Molinari 2025, Eq. (7) in time; doi 10.1103/tj41-6qqk. */
class ComputeVelocityMemory : public Compute, public grainscope::DeclaresOutputs {
 public:
  ComputeVelocityMemory(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeVelocityMemory() override;
  void init() override;
  double compute_scalar() override;
  void compute_vector() override;
  void compute_array() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;

  void sample_if_due();
  void forget_others(const grainscope::Fluctuations &motion);
  void sample(double strain);
  void fill_array();
};

}

#endif
#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(nematic,ComputeNematic)

#else

#ifndef LMP_COMPUTE_NEMATIC_H
#define LMP_COMPUTE_NEMATIC_H

#include "compute.h"
#include "outputs.h"
#include <memory>

namespace LAMMPS_NS {

/** Nematic order of the grains' symmetry axes p_i, |p_i| = 1:
 *  Q_ab = 1/N sum_i (p_ia p_ib - delta_ab/3), S2 = 3/2 max eigenvalue(Q).
 *  Scalar: S2, in [0,1]; 0 for an empty group and for spheres.
 *  Source: Bilotto, Trulsson & Molinari 2025, Eq. (3), Fig. 2; doi 10.1103/tj41-6qqk. */
class ComputeNematic : public Compute, public grainscope::DeclaresOutputs {
 public:
  ComputeNematic(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeNematic() override;
  void init() override;
  double compute_scalar() override;
  void compute_vector() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}

#endif
#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(fluctuation,ComputeFluctuation)

#else

#ifndef LMP_COMPUTE_FLUCTUATION_H
#define LMP_COMPUTE_FLUCTUATION_H

#include "compute.h"
#include "outputs.h"
#include <memory>

namespace LAMMPS_NS {

/** Fluctuations of velocity, dv, against a mean flow and of angular velocity, dw = omega - <omega>, and how straight
 *  the mean flow is. E_tr = 1/2 sum m |dv|^2, E_rot = 1/2 sum dw.J dw.
 *  Scalar: lever effect sqrt<|dv|^2>/(|rate| d_eq). Array: layers, mean velocity less the box's flow. Zero for an
 *  empty group; lever and deviations also without shear.
 *  Source: Bilotto, Trulsson & Molinari 2025, Figs. 5, 6; doi 10.1103/tj41-6qqk. */
class ComputeFluctuation : public Compute, public grainscope::DeclaresOutputs {
 public:
  ComputeFluctuation(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeFluctuation() override;
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

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

/** Fluctuations of velocity, dv, against a mean flow and of angular velocity, dw = omega - <omega>, and how straight the mean flow is.
 *  scalar: lever effect sqrt<|dv|^2>/(|rate| d_eq) [-], intensive.
 *  vector (14, intensive except 7, 8): 1-3 rms dv [velocity], 4-6 rms dw [1/time], 7 E_tr = 1/2 sum m |dv|^2, 8 E_rot = 1/2 sum dw.J dw
 *  [energy], 9 E_rot/E_tr, 10 lever, 11 shear rate of the box, 12 measured shear rate [1/time], 13 deviation of the velocity profile from the
 *  box's flow, 14 what noise alone would give, both over |rate| L [-].
 *  array (layers x 5): 1 coordinate of the layer's middle from the box centre [distance], 2 grains, 3-5 mean velocity less the box's
 *  flow [velocity]. Zero for an empty group; 10, 13, 14 also without shear.
 *  Source: Bilotto, Trulsson & Molinari 2025, Figs. 5, 6; doi 10.1103/tj41-6qqk. */
class ComputeFluctuation : public Compute, public grainscope::DeclaresOutputs {
 public:
  ComputeFluctuation(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeFluctuation();
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

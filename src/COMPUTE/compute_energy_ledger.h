// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(energy/ledger,ComputeEnergyLedger)

#else

#ifndef LMP_COMPUTE_ENERGY_LEDGER_H
#define LMP_COMPUTE_ENERGY_LEDGER_H

#include "compute.h"
#include "outputs.h"

namespace LAMMPS_NS {

/** Where the energy of a group goes: what came in (W), what is stored (U, K) and what was lost (D, G) since the compute
 *  was defined, whether it adds up (residual), and the rates of all of these in the last step, 0 before the first step;
 *  the share of walls in them (_w), the share of each axis in W_box.
 *  Scalar: |residual| over |D_n| + |D_t| + |D_damp| + |D_rolling|; 0 while nothing was lost. Zero for an empty group.
 */
class ComputeEnergyLedger : public Compute, public grainscope::DeclaresOutputs {
 public:
  ComputeEnergyLedger(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeEnergyLedger() override;
  void init() override;
  double compute_scalar() override;
  void compute_vector() override;

 private:
  double relative_ = 0.0;  // the residual, over what was lost
};

}

#endif
#endif

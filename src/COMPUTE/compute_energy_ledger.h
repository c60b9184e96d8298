// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(energy/ledger,ComputeEnergyLedger)

#else

#ifndef LMP_COMPUTE_ENERGY_LEDGER_H
#define LMP_COMPUTE_ENERGY_LEDGER_H

#include "compute.h"
#include "outputs.h"

namespace LAMMPS_NS {

/** Where the energy of a group goes: what came in, what is stored and what was lost since the compute was defined, and whether it adds up.
 *  scalar: |residual| over |D_n| + |D_t| + |D_damp| + |D_rolling| [-], intensive; 0 while nothing was lost.
 *  vector (37, extensive but for 19): 1-4 work W_shear, W_box, W_frame, W_other [energy]; 5-8 losses D_n, D_t, D_damp, D_rolling; 9-13 what the
 *  contact law and the time step take G_k, G_p, G_n, G_open, G_dt; 14-17 stored now U_n, U_t, K_tr, K_rot; 18 residual, 19 the same over the
 *  losses as above; 20-37 the rates of 1-18 in the last step [power], 0 before the first. Zero for an empty group. */
class ComputeEnergyLedger : public Compute, public grainscope::DeclaresOutputs {
 public:
  ComputeEnergyLedger(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeEnergyLedger();
  void init() override;
  double compute_scalar() override;
  void compute_vector() override;
};

}

#endif
#endif

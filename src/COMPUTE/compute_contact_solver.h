// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(contact/solver,ComputeContactSolver)

#else

#ifndef LMP_COMPUTE_CONTACT_SOLVER_H
#define LMP_COMPUTE_CONTACT_SOLVER_H

#include "compute.h"
#include "outputs.h"

namespace LAMMPS_NS {

/** What the contact solver of `surface ellipsoid` did since pair_style gran/insitu was defined, summed over ranks; see
 *  doc/compute_contact_solver.md. Scalar: fallbacks, 0 in a sound run. */
class ComputeContactSolver : public Compute, public grainscope::DeclaresOutputs {
 public:
  ComputeContactSolver(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  void init() override;
  double compute_scalar() override;
  void compute_vector() override;
};

}

#endif
#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(contact/surface,ComputeContactSurface)

#else

#ifndef LMP_COMPUTE_CONTACT_SURFACE_H
#define LMP_COMPUTE_CONTACT_SURFACE_H

#include "contact_compute.h"
#include "outputs.h"
#include <memory>

namespace LAMMPS_NS {

/** Contacts binned on the grains' surface by the angle psi between contact point and axis, psi in (0, pi/2); each
 *  contact counts on both of its grains, its powers half to each.
 *  Array: bins rows. Vector: P, mean area A_p, grains. inhomogeneity = (Pi_j/A_j)/(Pi_tot/A_p). All 0 for an empty
 *  group, but psi.
 *  Source: Bilotto, Trulsson & Molinari 2025, Eq. (10), Figs. 11, 12; doi 10.1103/tj41-6qqk. */
class ComputeContactSurface : public grainscope::ContactCompute, public grainscope::DeclaresOutputs {
 public:
  ComputeContactSurface(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeContactSurface() override;
  void init() override;
  void begin_contacts() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;

  void require_one_shape();
  void measure_grains();
  void answer() override;
};

}

#endif
#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(contact/surface,ComputeContactSurface)

#else

#ifndef LMP_COMPUTE_CONTACT_SURFACE_H
#define LMP_COMPUTE_CONTACT_SURFACE_H

#include "contact_compute.h"
#include <memory>

namespace LAMMPS_NS {

/** Contacts binned on the grains' surface by the angle psi between contact point and axis, psi in (0, pi/2); each contact counts on both
 *  of its grains, its powers half to each.
 *  array (bins x 17): 1 psi of the bin's middle [rad], 2 area A_j [distance^2] (mean over grains), 3 contacts N_j, 4 rho_s [1/distance^2],
 *  5 rho_s A_p [-], 6 F_n/(P A_p), 7 |F_t|/(P A_p), 8 mobilisation, 9 sliding fraction (means over the bin's contacts, [-]), 10 P_n,
 *  11 P_t [energy/time], 12 inhomogeneity (Pi_j/A_j)/(Pi_tot/A_p), 13 the same as the paper prints it [-], 14-17 the sums that 6-9 are
 *  means of [-].
 *  vector (3): P [pressure], mean area A_p [distance^2], grains. All 0 for an empty group, but 1.
 *  Source: Bilotto, Trulsson & Molinari 2025, Eq. (10), Figs. 11, 12; doi 10.1103/tj41-6qqk. */
class ComputeContactSurface : public grainscope::ContactCompute {
 public:
  ComputeContactSurface(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeContactSurface();
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

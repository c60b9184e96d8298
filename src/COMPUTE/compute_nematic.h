// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(nematic,ComputeNematic)

#else

#ifndef LMP_COMPUTE_NEMATIC_H
#define LMP_COMPUTE_NEMATIC_H

#include "compute.h"
#include "outputs.h"

namespace LAMMPS_NS {

/** Nematic order of the grains' symmetry axes p_i, |p_i| = 1:
 *  Q_ab = 1/N sum_i (p_ia p_ib - delta_ab/3), S2 = 3/2 max eigenvalue(Q).
 *  scalar: S2 [-], intensive, in [0,1]; 0 for an empty group and for spheres.
 *  vector (20, intensive except 16 and 17): Qxx Qyy Qzz Qxy Qxz Qyz, director x y z, biaxiality, theta_x and the director's own angle
 *  [rad], mean angular velocity x y z [1/time], grains with an axis, grains counted in theta_x, eigenvalues of Q (descending).
 *  Source: Bilotto, Trulsson & Molinari 2025, Eq. (3), Fig. 2; doi 10.1103/tj41-6qqk. */
class ComputeNematic : public Compute, public grainscope::DeclaresOutputs {
 public:
  ComputeNematic(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  void init() override;
  double compute_scalar() override;
  void compute_vector() override;
};

}

#endif
#endif

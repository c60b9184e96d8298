// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(fabric,ComputeFabric)

#else

#ifndef LMP_COMPUTE_FABRIC_H
#define LMP_COMPUTE_FABRIC_H

#include "contact_compute.h"
#include <memory>

namespace LAMMPS_NS {

/** Fabric of the true contact normals n, F_ab = 1/N_c sum n_a n_b, trace 1; a contact counts when both grains are in the group.
 *  scalar: deviator sqrt(3/2 F':F') [-], intensive, in [0,1].
 *  vector (22, and 6 for each weighted tensor asked for; [-], intensive except 22): 1-6 F xx yy zz xy xz yz, 7-9 eigenvalues (descending),
 *  10-18 their eigenvectors, 19 deviator, 20 principal angle in the plane [rad] in (-pi/2, pi/2], 21 ratio of the two largest
 *  eigenvalues, 22 contacts. Zero for an empty group.
 *  Source: Bilotto, Trulsson & Molinari 2025, Eq. (9), doi 10.1103/tj41-6qqk; the weighted tensors: Ouadfel & Rothenburg 2001,
 *  doi 10.1016/S0167-6636(00)00057-0. */
class ComputeFabric : public grainscope::ContactCompute {
 public:
  ComputeFabric(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeFabric();
  double memory_usage() override;
  bool needs_motion() const override { return false; }

 private:
  void answer() override;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}

#endif
#endif

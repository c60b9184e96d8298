// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(fabric,ComputeFabric)

#else

#ifndef LMP_COMPUTE_FABRIC_H
#define LMP_COMPUTE_FABRIC_H

#include "contact_compute.h"
#include "outputs.h"
#include <memory>

namespace LAMMPS_NS {

/** Fabric of the true contact normals n, F_ab = 1/N_c sum n_a n_b, trace 1; a contact counts when both grains are in
 *  the group. Scalar: deviator sqrt(3/2 F':F'), in [0,1]. Vector: F and what follows from it, then the weighted
 *  tensors asked for; angles in (-pi/2, pi/2]. Array, with 'rows types': the
 *  fabric of the contacts of each pair of atom types. Zero for an empty group.
 *  Source: Bilotto, Trulsson & Molinari 2025, Eq. (9), doi 10.1103/tj41-6qqk; the weighted tensors: Ouadfel &
 *  Rothenburg 2001, doi 10.1016/S0167-6636(00)00057-0. */
class ComputeFabric : public grainscope::ContactCompute, public grainscope::DeclaresOutputs {
 public:
  ComputeFabric(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeFabric() override;
  double memory_usage() override;

 private:
  bool reads_motion() const override { return false; }
  void answer() override;
  void put_rows();

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}

#endif
#endif

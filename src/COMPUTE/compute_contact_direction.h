// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(contact/direction,ComputeContactDirection)

#else

#ifndef LMP_COMPUTE_CONTACT_DIRECTION_H
#define LMP_COMPUTE_CONTACT_DIRECTION_H

#include "contact_compute.h"
#include "outputs.h"
#include <memory>

namespace LAMMPS_NS {

/** Contact normals binned by their angle beta in a plane of the laboratory; each contact counts at beta and at beta
 *  + pi, with its two grains, so that the rows are symmetric to the last bit.
 *  Array: bins rows; forces are magnitudes of F_n and F_t projected on the plane, and the component of F_t along
 *  (-sin beta, cos beta), signed. Contacts whose projected normal is shorter than 1e-9 are left out. 0 for an empty
 *  group, but beta.
 *  Source: Bilotto, Trulsson & Molinari 2025, Eq. (F1), Fig. 17; doi 10.1103/tj41-6qqk. */
class ComputeContactDirection : public grainscope::ContactCompute, public grainscope::DeclaresOutputs {
 public:
  ComputeContactDirection(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeContactDirection() override;

 private:
  bool reads_motion() const override { return false; }
  void answer() override;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}

#endif
#endif

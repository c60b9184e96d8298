// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(contact/direction,ComputeContactDirection)

#else

#ifndef LMP_COMPUTE_CONTACT_DIRECTION_H
#define LMP_COMPUTE_CONTACT_DIRECTION_H

#include "contact_compute.h"
#include <memory>

namespace LAMMPS_NS {

/** Contact normals binned by their angle beta in a plane of the laboratory; each contact counts at beta and at beta + pi, with its two
 *  grains, so that the rows are symmetric to the last bit.
 *  array (bins x 9): 1 beta of the bin's middle [rad], in (0, 2 pi), 2 contacts, 3 density [1/rad], integral 1, means over the bin's
 *  contacts: 4 magnitude of F_n projected on the plane, 5 of F_t projected, 6 component of F_t along (-sin beta, cos beta), signed [force];
 *  7-9 the sums that 4-6 are means of [force].
 *  Contacts whose projected normal is shorter than 1e-9 are left out. 0 for an empty group, but 1.
 *  Source: Bilotto, Trulsson & Molinari 2025, Eq. (F1), Fig. 17; doi 10.1103/tj41-6qqk. */
class ComputeContactDirection : public grainscope::ContactCompute {
 public:
  ComputeContactDirection(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeContactDirection();
  bool needs_motion() const override { return false; }

 private:
  void answer() override;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}

#endif
#endif

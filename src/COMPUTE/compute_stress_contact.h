// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(stress/contact,ComputeStressContact)

#else

#ifndef LMP_COMPUTE_STRESS_CONTACT_H
#define LMP_COMPUTE_STRESS_CONTACT_H

#include "contact_compute.h"
#include "outputs.h"
#include "range_warning.h"
#include <memory>

namespace LAMMPS_NS {

/** Contact stress sigma_ab = -1/Omega sum_contacts F_a r_b (F on i, r = x_i - x_j, at a wall x_i less the contact
 *  point, each contact once, Omega the whole box; tension positive), its kinetic part -1/Omega sum m dv_a dv_b of
 *  peculiar velocities, and what follows from it. A contact counts when its grains are in the group. Scalar: P =
 *  -sigma_yy. Array, with 'rows types': the part of each pair of atom types. Ratios to P are 0 when P <= 0; everything
 *  is 0 for an empty group. With `dimension 2` Omega is the area L_x L_y, stress is force per length as in compute
 *  pressure, what has a z is 0, N2 too, and the E of kappa is Young's modulus times the mean diameter.
 *  Source: Bilotto, Trulsson & Molinari 2025, Eq. (2), App. D, G; doi 10.1103/tj41-6qqk. */
class ComputeStressContact : public grainscope::ContactCompute, public grainscope::DeclaresOutputs {
 public:
  ComputeStressContact(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeStressContact() override;
  void init() override;

 private:
  bool reads_motion() const override { return false; }
  bool uses_bodies() const override { return true; }
  struct Impl;
  std::unique_ptr<Impl> impl_;
  grainscope::RangeWarning soft_;
  double stiffness_ = 0.0;  // kappa P^(2/3), as of the last neighbour list or the last change between two runs

  void answer() override;
  void put_rows(double unit);
  bool knows_sliding() const;
  double softest_modulus() const;
  double flattest_shape() const;
  double mean_diameter() const;
};

}

#endif
#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(dissipation,ComputeDissipation)

#else

#ifndef LMP_COMPUTE_DISSIPATION_H
#define LMP_COMPUTE_DISSIPATION_H

#include "contact_compute.h"
#include "outputs.h"
#include <memory>

namespace LAMMPS_NS {

/** Power dissipated by contacts of the group, positive = energy lost per time; contacts between grains and with walls
 *  are separate.
 *  mode instantaneous: P_n = -sum F_damping u_n, P_t = -sum_sliding F_t . u_t, with the velocities that entered the
 *  force.
 *  mode step: P_n pairs the damping forces with the velocities at the end of the step; P_t = sum |F_t| slip / dt, with
 *  slip the length cut from the spring.
 *  mode ledger: both as compute energy/ledger books them, exact. P_t,damp is the loss of tangential damping, paired as
 *  P_n; a wall keeps the velocity that it had in the evaluation. Scalar: the sum of all. Zero for an empty group.
 *  Source: Bilotto, Trulsson & Molinari 2025, Eq. (4), App. B; doi 10.1103/tj41-6qqk. */
class ComputeDissipation : public grainscope::ContactCompute, public grainscope::DeclaresOutputs {
 public:
  ComputeDissipation(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeDissipation() override;
  void init() override;
  bool needs_images() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;

  void answer() override;
  bool answers_after_run() const override;
  void answer_by_ledger();
  void put(const double *values);
  void put_rows();
};

}

#endif
#endif

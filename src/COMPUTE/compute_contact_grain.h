// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(contact/grain,ComputeContactGrain)

#else

#ifndef LMP_COMPUTE_CONTACT_GRAIN_H
#define LMP_COMPUTE_CONTACT_GRAIN_H

#include "contact_compute.h"
#include "outputs.h"
#include <memory>

namespace LAMMPS_NS {

/** Contacts of each grain, to colour pictures of grains; contacts between grains of the group. Powers are
 *  instantaneous, half of the power of each contact; theta is in (-pi/2, pi/2], 0 for spheres. Zero outside the group.
 *  Source: Bilotto, Trulsson & Molinari 2025, Eq. (4), Figs. 2, 12; doi 10.1103/tj41-6qqk. */
class ComputeContactGrain : public grainscope::ContactCompute, public grainscope::DeclaresOutputs {
 public:
  ComputeContactGrain(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeContactGrain() override;
  void init() override;
  void compute_peratom() override;
  double memory_usage() override;

  void begin_contacts() override;
  void add_contacts(grainscope::ContactSpan contacts) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;

  void require_same_grains() const;
  double angle_to_flow(int i) const;
};

}

#endif
#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(contact/grain,ComputeContactGrain)

#else

#ifndef LMP_COMPUTE_CONTACT_GRAIN_H
#define LMP_COMPUTE_CONTACT_GRAIN_H

#include "contact_compute.h"
#include <memory>

namespace LAMMPS_NS {

/** What a grain's contacts do, grain by grain, to colour a picture by; contacts between grains of the group.
 *  per-atom array (6 columns): 1 contacts, 2 sliding contacts, 3 P_n, 4 P_t [energy/time] (instantaneous, half of each contact's), 5 mean
 *  mobilisation [-], 6 angle theta of the major axis to the flow x in the xy plane [rad], in (-pi/2, pi/2], 0 for spheres. Zero outside the group.
 *  Source: Bilotto, Trulsson & Molinari 2025, Eq. (4), Figs. 2, 12; doi 10.1103/tj41-6qqk. */
class ComputeContactGrain : public grainscope::ContactCompute {
 public:
  ComputeContactGrain(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeContactGrain();
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

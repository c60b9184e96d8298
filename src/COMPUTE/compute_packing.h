// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(packing,ComputePacking)

#else

#ifndef LMP_COMPUTE_PACKING_H
#define LMP_COMPUTE_PACKING_H

#include "contact_network_compute.h"
#include "outputs.h"
#include <memory>
#include <vector>

namespace LAMMPS_NS {

/** The standard numbers of a state: solid fraction phi = sum V_i/Omega [-], mean equivalent diameter d [distance],
 *  inertial number I = rate d sqrt(rho/P) [-], coordination number Z = (2 N_c + N_w)/N with and without rattlers [-],
 *  and what they are made of. Rattlers have fewer than `rattlers` contacts, those with rattlers not counted.
 *  scalar: phi. All 0 for an empty group, but rate and Omega.
 *  Sources: GDR MiDi 2004, doi 10.1140/epje/i2003-10153-0 (I); O'Hern et al. 2003, doi 10.1103/PhysRevE.68.011306
 *  (rattlers). */
class ComputePacking : public grainscope::ContactNetworkCompute, public grainscope::DeclaresOutputs {
 public:
  ComputePacking(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputePacking() override;
  void init() override;
  void begin_contacts() override;
  void add_contacts(grainscope::ContactSpan contacts) override;
  void end_contacts() override;
  bool needs_images() const override { return false; }

 private:
  bool reads_motion() const override { return false; }
  bool uses_bodies() const override { return true; }
  void answer() override;
  std::vector<double> grains_of_group() const;
  void find_rattlers(std::vector<double> &held);
  void add_grain(int i, bool rattler);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}

#endif
#endif

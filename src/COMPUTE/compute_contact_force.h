// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(contact/force,ComputeContactForce)

#else

#ifndef LMP_COMPUTE_CONTACT_FORCE_H
#define LMP_COMPUTE_CONTACT_FORCE_H

#include "contact_network_compute.h"
#include "outputs.h"
#include <memory>

namespace LAMMPS_NS {

/** Statistics of contact forces: mean, rms and largest F_n and |F_t|; the density P(f) of f = F_n/<F_n>, integral 1;
 *  its exponents of largest likelihood, P ~ exp(-beta f) beyond `tail` and P ~ f^-alpha below 1; strong contacts, f >
 *  1, what they carry, and the clusters of grains that they connect.
 *  scalar: <F_n> [force], intensive. Array: bins rows. All 0 for an empty group, but f.
 *  Sources: Radjai, Jean, Moreau & Roux 1996, doi 10.1103/PhysRevLett.77.274; Mueth, Jaeger & Nagel 1998, doi
 *  10.1103/PhysRevE.57.3164; Radjai, Wolf, Jean & Moreau 1998, doi 10.1103/PhysRevLett.80.61. */
class ComputeContactForce : public grainscope::ContactNetworkCompute, public grainscope::DeclaresOutputs {
 public:
  ComputeContactForce(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeContactForce() override;
  void begin_contacts() override;
  void add_contacts(grainscope::ContactSpan contacts) override;
  void end_contacts() override;
  double memory_usage() override;

 private:
  bool reads_motion() const override { return false; }
  bool uses_bodies() const override { return true; }
  void answer() override;
  void find_clusters(double mean);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}

#endif
#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(contact/local,ComputeContactLocal)

#else

#ifndef LMP_COMPUTE_CONTACT_LOCAL_H
#define LMP_COMPUTE_CONTACT_LOCAL_H

#include "contact_network_compute.h"
#include "outputs.h"
#include <memory>

namespace LAMMPS_NS {

/** One row per contact of the group, with a grain or a wall, straight from the force evaluation that drove the step,
 *  each contact once over all ranks; for dump local. Per grain the forces of the rows sum to f. Columns by keyword; by
 *  default all that contacts between grains have, in the order of the table in doc/compute_contact_local.md. */
class ComputeContactLocal : public grainscope::ContactNetworkCompute, public grainscope::DeclaresOutputs {
 public:
  ComputeContactLocal(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeContactLocal() override;
  void compute_local() override;
  double memory_usage() override;

  void begin_contacts() override;
  void add_contacts(grainscope::ContactSpan contacts) override;
  void end_contacts() override;

 private:
  bool reads_motion() const override;
  bool uses_bodies() const override;
  struct Impl;
  std::unique_ptr<Impl> impl_;

  void add_row(const grainscope::Contact &contact);
};

}

#endif
#endif

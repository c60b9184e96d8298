// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(wall/contact,ComputeWallContact)

#else

#ifndef LMP_COMPUTE_WALL_CONTACT_H
#define LMP_COMPUTE_WALL_CONTACT_H

#include "contact_compute.h"
#include "outputs.h"
#include <memory>

namespace grainscope {
struct Wall;
}

namespace LAMMPS_NS {

/** Contacts of the group with walls, a row for each wall and the sum of the rows: contacts, force and torque on the
 *  wall, tractions, the power that the wall gives to the grains, losses, and, with `impacts yes`, the grains that began
 *  to touch it since the compute was defined. Zero for an empty group. */
class ComputeWallContact : public grainscope::ContactCompute, public grainscope::DeclaresOutputs {
 public:
  ComputeWallContact(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeWallContact() override;
  void init() override;
  bool wants_contacts() override;
  void begin_contacts() override;
  void add_contacts(grainscope::ContactSpan contacts) override;
  void end_contacts() override;
  double memory_usage() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;

  void answer() override;
  void require_losses() const;
  void warn_of_unknown_areas();
  void warn_of_walls_across(const grainscope::Wall &wall, double given);
};

}

#endif
#endif

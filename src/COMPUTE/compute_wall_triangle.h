// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(wall/triangle,ComputeWallTriangle)

#else

#ifndef LMP_COMPUTE_WALL_TRIANGLE_H
#define LMP_COMPUTE_WALL_TRIANGLE_H

#include "contact_compute.h"
#include "outputs.h"
#include <memory>

namespace LAMMPS_NS {

/** One row per triangle of mesh walls: its place and area, and pressure, power lost by friction and wear by Archard's
 *  law, per area, from contacts with grains of the group. Each triangle once over all ranks, with the sums of all
 *  ranks; for dump local. */
class ComputeWallTriangle : public grainscope::ContactCompute, public grainscope::DeclaresOutputs {
 public:
  ComputeWallTriangle(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeWallTriangle() override;
  void init() override;
  bool wants_contacts() override;
  void begin_contacts() override;
  void end_contacts() override;
  void compute_local() override;
  double memory_usage() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}

#endif
#endif

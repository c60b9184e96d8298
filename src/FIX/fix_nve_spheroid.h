// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(nve/spheroid,FixNVESpheroid)

#else

#ifndef LMP_FIX_NVE_SPHEROID_H
#define LMP_FIX_NVE_SPHEROID_H

#include "fix_nve.h"

namespace grainscope {
struct Spheroids;
}

namespace LAMMPS_NS {

/** Moves grains of two equal moments of inertia by kick, drift, kick; the drift turns them exactly
 *  (spheroid_motion.h). Velocities and angular momenta are kicked by f dt/2m and torque dt/2, before and after. No
 *  output, no state. */
class FixNVESpheroid : public FixNVE {
 public:
  FixNVESpheroid(class LAMMPS *lmp, int narg, char **arg);
  int setmask() override;
  void init() override;
  void initial_integrate(int vflag) override;
  void final_integrate() override;
  void setup_pre_neighbor() override { require_symmetric_tops(); }
  void pre_neighbor() override { require_symmetric_tops(); }

 private:
  int grains() const;
  grainscope::Spheroids spheroids() const;
  void require_symmetric_tops() const;
};

}

#endif
#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(press/strain,FixPressStrain)

#else

#ifndef LMP_FIX_PRESS_STRAIN_H
#define LMP_FIX_PRESS_STRAIN_H

#include "contact_sink.h"
#include "fix_deform.h"
#include "outputs.h"
#include <array>
#include <memory>

namespace grainscope {
class BoxJump;
struct BoxState;
struct NetworkResponse;
class PressStrainHostArguments;
}

namespace LAMMPS_NS {

/** Deforms the box along a path. Each edge is fixed, moves at a true rate, or moves so that the pressure along it (or,
 *  with other edges, the mean pressure) is held. Each tilt is sheared at a true rate, or so that a shear stress is
 *  held. Stresses are controlled at intervals of strain, time or steps. Scalar: pressure averaged over the last
 *  completed interval. To LIGGGHTS it is a fix deform, so that velocities are remapped across the moving faces. Source:
 *  Bilotto, Trulsson & Molinari 2025, Sec. II; doi 10.1103/tj41-6qqk. */
class FixPressStrain : public FixDeform, public grainscope::DeclaresOutputs, public grainscope::ContactSink {
 public:
  FixPressStrain(class LAMMPS *lmp, int narg, char **arg);
  ~FixPressStrain() override;

  void init() override;
  void setup(int vflag) override;
  void pre_exchange() override;
  void end_of_step() override;
  void write_restart(FILE *file) override;
  void restart(char *buffer) override;
  double compute_scalar() override;
  double compute_vector(int n) override;

  bool wants_contacts() override { return true; }
  void begin_contacts() override;
  void add_contacts(grainscope::ContactSpan contacts) override;
  bool takes_lanes() const override { return true; }
  bool lanes_need_motion() const override { return false; }
  void add_lanes(const grainscope::ContactLanes &contacts) override;
  void end_contacts() override;

  /** The velocity that grains outside the box got from the change of the box's velocities at the end of the last step,
   *  by the only fix press/strain of the input script; null without one, or before the first step of a run. */
  static const grainscope::BoxJump *last_jump_of(class LAMMPS *lmp);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;

  FixPressStrain(class LAMMPS *lmp, int narg, char **arg, const grainscope::PressStrainHostArguments &host);

  void evaluate_variables();
  double strain_rate() const;
  double progress_of_a_step() const;
  double time_between_inputs() const;
  void plan_flip();
  void give_new_velocity_outside(const grainscope::BoxState &before);
  void take_input();
  bool set_driven_rates(const grainscope::NetworkResponse &mean);
  double resistance_of(const grainscope::NetworkResponse &mean, int loop, double interval) const;
  double mean_stiffness(const grainscope::NetworkResponse &mean) const;
  double inertial_resistance(const grainscope::NetworkResponse &mean, int mode) const;
  void add_kinetic_part(std::array<double, 6> &pressures, double factor) const;
  const std::array<double, 6> &pressures_now();
  double relative_error() const;
};

}

#endif
#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(press/strain,FixPressStrain)

#else

#ifndef LMP_FIX_PRESS_STRAIN_H
#define LMP_FIX_PRESS_STRAIN_H

#include "contact_sink.h"
#include "fix_deform.h"
#include "outputs.h"
#include <memory>

namespace grainscope {
class PressStrainHostArguments;
}

namespace LAMMPS_NS {

/** Shears the box at a true rate and holds the normal pressure along one axis by moving that box length at strain
 *  (or time) intervals. Scalar: pressure averaged over the last completed interval. It is a fix deform to the host,
 *  which then remaps velocities across the moving faces. Source: Bilotto, Trulsson & Molinari 2025, Sec. II; doi
 *  10.1103/tj41-6qqk. */
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

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;

  FixPressStrain(class LAMMPS *lmp, int narg, char **arg, const grainscope::PressStrainHostArguments &host);

  void evaluate_variables();
  double progress_of_a_step() const;
  double time_between_inputs() const;
  void plan_flip();
  void take_input();
  double kinetic_pressure() const;
  double pressure_now();
  double relative_error() const;
};

}

#endif
#endif

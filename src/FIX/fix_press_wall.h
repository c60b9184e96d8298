// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(press/wall,FixPressWall)

#else

#ifndef LMP_FIX_PRESS_WALL_H
#define LMP_FIX_PRESS_WALL_H

#include "contact_sink.h"
#include "fix_move_mesh.h"
#include "outputs.h"
#include <memory>

namespace LAMMPS_NS {

/** Holds the pressure of grains on a mesh of fix wall/gran by moving the mesh along an axis, with the law of fix
 *  press/strain: at each input V = k_p (Pbar - P_t) away from the grains, where Pbar is their mean force per area since
 *  the last input; V is held until the next input. Scalar: Pbar of the last completed interval. To LIGGGHTS it is a fix
 *  move/mesh, so that it keeps the mesh as long as the fix exists. Source of the law: Bilotto, Trulsson & Molinari
 *  2025, Sec. II; doi 10.1103/tj41-6qqk. */
class FixPressWall : public FixMoveMesh, public grainscope::DeclaresOutputs, public grainscope::ContactSink {
 public:
  FixPressWall(class LAMMPS *lmp, int narg, char **arg);
  ~FixPressWall() override;

  int setmask() override;
  void post_create() override;
  void init() override;
  void setup_pre_force(int vflag) override;
  void setup(int vflag) override;
  void initial_integrate(int vflag) override;
  void end_of_step() override;
  void write_restart(FILE *file) override;
  void restart(char *buffer) override;
  double compute_scalar() override;
  double compute_vector(int n) override;

  bool wants_contacts() override { return true; }
  void begin_contacts() override;
  void add_contacts(grainscope::ContactSpan contacts) override;
  void end_contacts() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;

  FixPressWall(class LAMMPS *lmp, std::unique_ptr<Impl> impl);

  void know_grains();
  void evaluate_target();
  double time_between_inputs() const;
  double area() const;
  void take_input();
  double pressure_now();
};

}

#endif
#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(displacement/shear,ComputeDisplacementShear)

#else

#ifndef LMP_COMPUTE_DISPLACEMENT_SHEAR_H
#define LMP_COMPUTE_DISPLACEMENT_SHEAR_H

#include "box_watcher.h"
#include "compute.h"
#include "fluctuations.h"
#include "outputs.h"
#include <memory>
#include <vector>

namespace LAMMPS_NS {

class FixGrainRecord;

/** Displacement of grains relative to the affine motion of a sheared box since a given strain. Between two calls, with
 *  X the position of a grain with image flags from boxlo + (L_x, L_y, L_z)/2, H the box edges with the driven tilt
 *  continued through flips, and s = H^-1 X:  d += (H_1 + H_2)/2 (s_2 - s_1). Relative to another mean flow:  d += u
 *  less the mean flow of u, where u is d of the box plus, if the flow is fitted or given, the affine motion.
 *  Along an axis with shrink-wrapped faces (boundary s or m) there is no affine motion: the edge is taken as it is at
 *  the second call.
 *  Scalar: <d_y^2>. Vector: strain, <d^2>, and D, half their slope over strain, by least squares with free intercept
 *  over all calls. Zero before the start and for an empty group.
 *  Source: Bilotto, Trulsson & Molinari 2025, App. E, Fig. 16; doi 10.1103/tj41-6qqk. */
class ComputeDisplacementShear : public Compute, public grainscope::DeclaresOutputs, public grainscope::BoxWatcher {
 public:
  ComputeDisplacementShear(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  ~ComputeDisplacementShear() override;
  void init() override;
  double compute_scalar() override;
  void compute_vector() override;
  void before_change_box() override;
  void after_change_box() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;

  grainscope::Bodies bodies_now() const;
  void subtract_mean(std::vector<grainscope::Fluctuations::Grain> moved, std::vector<Eigen::Vector3d> places);
  void begin(double strain);
  bool has(int i, const grainscope::Bodies &bodies) const;
  Eigen::Vector3d centre(int i, const grainscope::Bodies &bodies) const;
  void forget_those_outside();
  void follow(double strain);
  void advance();
  void require_flow_of_all();
  void measure(double strain);
};

}

#endif
#endif

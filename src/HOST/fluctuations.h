// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FLUCTUATIONS_H
#define GRAINSCOPE_FLUCTUATIONS_H

#include "box_state.h"
#include "plane.h"
#include <string>
#include <vector>

namespace LAMMPS_NS { class LAMMPS; }

namespace grainscope {

class Arguments;

/** What is taken for the mean flow: the affine flow of the box; a given rate; the straight line fitted to the velocities; or the mean
 *  of each of `layers` layers across the gradient. The group's mean (by mass) is taken out in each case. */
struct MeanFlow {
  enum class Kind { box, rate, fit, layers } kind = Kind::box;
  double rate = 0.0;
  int layers = 0;
  Plane plane;

  /** Reads what follows the keyword 'flow': box, rate G, fit or layers n. */
  void read(Arguments &arguments);
};

/** How the grains of a group move against a mean flow, dv, and spin against their mean, dw = omega - <omega>. Collective. */
class Fluctuations {
 public:
  struct Grain {
    int index;              // local index of the host
    double mass;
    Eigen::Vector3d velocity, spin;
  };

  Fluctuations(LAMMPS_NS::LAMMPS *lmp, int groupbit, const BoxState &box, const MeanFlow &flow);

  /** This rank's grains of the group. */
  const std::vector<Grain> &local() const { return local_; }
  /** Number of grains over all ranks. */
  double grains() const { return grains_; }
  /** Slope of the fitted line, d<v>/dx_gradient; zero for other mean flows. */
  const Eigen::Vector3d &slope() const { return slope_; }

 private:
  LAMMPS_NS::LAMMPS *lmp_;
  std::vector<Grain> local_;
  double grains_ = 0.0;
  Eigen::Vector3d slope_ = Eigen::Vector3d::Zero();

  void subtract_means();
  void subtract_line(int gradient);
  void subtract_layers(const BoxState &box, int gradient, int layers);
};

/** Ends the run unless `grains`, the number over all ranks of those that no layer holds, is 0. */
void require_layers(LAMMPS_NS::LAMMPS *lmp, const std::string &who, double grains);

}

#endif

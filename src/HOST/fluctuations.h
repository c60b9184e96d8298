// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FLUCTUATIONS_H
#define GRAINSCOPE_FLUCTUATIONS_H

#include "bodies.h"
#include "box_state.h"
#include "plane.h"
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace grainscope {

class Arguments;
class RegionSolid;

/** Grains of a group, and where it is given with their centres in a region. */
struct ChosenGrains {
  int groupbit;
  const RegionSolid *region = nullptr;

  ChosenGrains(int groupbit, const RegionSolid *region = nullptr) : groupbit(groupbit), region(region) {}
};

/** What is taken for the mean flow: the affine flow of the box; a given rate; the straight line fitted to the
 *  velocities; or the mean of each of `layers` layers across the gradient. The group's mean (by mass) is taken out in
 *  each case. */
struct MeanFlow {
  enum class Kind { box, rate, fit, layers } kind = Kind::box;
  double rate = 0.0;
  int layers = 0;
  Plane plane;

  /** Reads what follows the keyword 'flow': box, rate G, fit or layers n. */
  void read(Arguments &arguments);
};

/** How the grains of a group move and spin against a mean flow, a clump as one grain: u = v - flow, dv = u - <u> by
 *  mass, dw = omega - <omega>, where the means are those of the group, or with flow layers of each layer. Collective. */
class Fluctuations {
 public:
  struct Grain {
    int index;  // local index of the host; of a clump, of the sphere that stands for it
    int layer;  // 0 without layers
    double mass;
    Eigen::Vector3d u;
    const Body *body;  // null for a grain on its own
  };

  /** Against the affine flow of the box; spins are not asked for. */
  Fluctuations(LAMMPS_NS::LAMMPS *lmp, ChosenGrains chosen, const BoxState &box);
  Fluctuations(LAMMPS_NS::LAMMPS *lmp, ChosenGrains chosen, const BoxState &box, const MeanFlow &flow);

  /** This rank's grains of the group. */
  const std::vector<Grain> &local() const { return local_; }
  Eigen::Vector3d velocity(const Grain &grain) const { return grain.u - means_[grain.layer].velocity; }
  Eigen::Vector3d spin(const Grain &grain) const { return own_spin(grain) - means_[grain.layer].spin; }
  /** Its centre. */
  Eigen::Vector3d place(const Grain &grain) const;
  /** 1/2 w.J w, J its inertia. */
  double rotational_energy(const Grain &grain, const Eigen::Vector3d &w) const;
  /** Of the sphere of its volume. */
  double equivalent_diameter(const Grain &grain) const;
  /** Number of grains over all ranks. */
  double grains() const { return grains_; }
  /** <u> of a flow without layers; zero for an empty group. */
  const Eigen::Vector3d &drift() const { return means_[0].velocity; }
  /** Sum m dv dv over all ranks. Collective. */
  Eigen::Matrix3d momentum_flux() const;
  /** Slope of the fitted line, d<v>/dx_gradient; zero for other mean flows. */
  const Eigen::Vector3d &slope() const { return slope_; }

 private:
  struct Mean {
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), spin = Eigen::Vector3d::Zero();
  };

  LAMMPS_NS::LAMMPS *lmp_;
  Bodies bodies_;
  std::vector<Grain> local_;
  std::vector<Mean> means_;  // of each layer
  double grains_ = 0.0;
  Eigen::Vector3d slope_ = Eigen::Vector3d::Zero();

  Eigen::Vector3d own_spin(const Grain &grain) const;
  template <class Flow>
  void collect(ChosenGrains chosen, Flow flow);
  template <class Flow>
  void collect_with_bodies(ChosenGrains chosen, Flow flow);
  void find_layers(const BoxState &box, int gradient, int layers);
  void subtract_line(int gradient);
  void find_mean_velocity();
  void find_means();
};

/** Ends the run unless `grains`, the number over all ranks of those that no layer holds, is 0. */
void require_layers(LAMMPS_NS::LAMMPS *lmp, const std::string &who, double grains);

}

#endif

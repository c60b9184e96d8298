// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FLUCTUATIONS_H
#define GRAINSCOPE_FLUCTUATIONS_H

#include "bodies.h"
#include "box_state.h"
#include "plane.h"
#include <array>
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
  std::string who;  // asks, for messages
  int groupbit;
  const RegionSolid *region = nullptr;

  ChosenGrains(const std::string &who, int groupbit, const RegionSolid *region = nullptr)
      : who(who), groupbit(groupbit), region(region) {}
};

/** The mean flow: the affine flow of the box; none; a given rate; the straight line fitted to the velocities; the
 *  velocity gradient fitted to them; the mean of each of `layers` layers across the gradient; or the mean of each cell
 *  of the box. In each case the mean velocity of the grains (by mass) is subtracted. */
struct MeanFlow {
  enum class Kind { box, none, rate, fit, gradient, layers, cells } kind = Kind::box;
  double rate = 0.0;
  int layers = 0;
  std::array<int, 3> cells{{1, 1, 1}};
  Plane plane;

  /** How many means there are. */
  int means() const { return kind == Kind::layers ? layers : kind == Kind::cells ? cells[0] * cells[1] * cells[2] : 1; }
  /** All that it says, for what must not change in a restart. */
  std::string text() const;
  /** Reads what follows the keyword 'flow': box, none, rate G, fit, gradient, layers n or cells nx ny nz. */
  void read(Arguments &arguments);
};

/** How the grains of a group move and spin against a mean flow, a clump as one grain: u = v - flow, dv = u - <u> by
 *  mass, dw = omega - <omega>, where the means are those of the grains, or with flow layers and cells of each layer and
 * cell. Collective. */
class Fluctuations {
 public:
  struct Grain {
    int index;  // local index of the host; of a clump, of the sphere that stands for it
    int layer;  // or cell; 0 without
    double mass;
    Eigen::Vector3d u;
    const Body *body;  // null for a grain on its own
  };

  /** Against the affine flow of the box; spins are not asked for. */
  Fluctuations(LAMMPS_NS::LAMMPS *lmp, const ChosenGrains &chosen, const BoxState &box);
  Fluctuations(LAMMPS_NS::LAMMPS *lmp, const ChosenGrains &chosen, const BoxState &box, const MeanFlow &flow);
  /** For displacements in place of velocities. `moved` holds u: the displacement, less the flow of the box where the
   *  mean flow is box, layers or cells; `places`: positions by local index. `flow rate` is a strain here. Spins are not
   *  available. */
  Fluctuations(LAMMPS_NS::LAMMPS *lmp, const std::string &who, std::vector<Grain> moved,
               std::vector<Eigen::Vector3d> places, const BoxState &box, const MeanFlow &flow);

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
  /** The fitted velocity gradient, dv_a/dx_b; zero for other mean flows. */
  const Eigen::Matrix3d &gradient() const { return gradient_; }

 private:
  struct Mean {
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), spin = Eigen::Vector3d::Zero();
  };

  LAMMPS_NS::LAMMPS *lmp_;
  Bodies bodies_;
  std::vector<Grain> local_;
  std::vector<Eigen::Vector3d> places_;  // by local index, where they are given
  std::vector<Mean> means_;              // of each layer or cell
  double grains_ = 0.0;
  Eigen::Vector3d slope_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d gradient_ = Eigen::Matrix3d::Zero();

  Eigen::Vector3d own_spin(const Grain &grain) const;
  template <class Flow>
  void collect(const ChosenGrains &chosen, Flow flow);
  template <class Flow>
  void collect_with_bodies(const ChosenGrains &chosen, Flow flow);
  void find_layers(const BoxState &box, const MeanFlow &flow);
  static Eigen::Vector3d shear(const MeanFlow &flow, const BoxState &box, const Eigen::Vector3d &x);
  void subtract_gradient();
  void subtract_line(int gradient);
  void find_mean_velocity();
  void find_means();
};

/** Sum of m dv dv of grains relative to the affine flow of the box, less their mean: the same as Fluctuations, and
 *  faster when all grains are counted. */
struct MomentumFlux {
  Eigen::Matrix3d sum;
  double grains;  // how many; both over all ranks
  /** Collective. */
  static MomentumFlux of(LAMMPS_NS::LAMMPS *lmp, const ChosenGrains &chosen, const BoxState &box);
};

/** Ends the run unless `grains`, the number over all ranks of those that no layer holds, is 0. */
void require_layers(LAMMPS_NS::LAMMPS *lmp, const std::string &who, double grains);

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ELLIPSOID_BODIES_H
#define GRAINSCOPE_ELLIPSOID_BODIES_H

#include "ellipsoid_contact.h"
#include "pair_group.h"
#include "neighbor.h"
#include "pointers.h"
#include "update.h"
#include <string>
#include <vector>

namespace grainscope {

/** What the solver did on this rank, since the pair style was defined. */
struct SolverCounts {
  double listed = 0.0;  // pairs in neighbour lists, once per force evaluation (own loop only)
  double solved = 0.0;  // pairs that the solver was asked for
  double touching = 0.0;
  double steps = 0.0;       // Newton steps
  double most_steps = 0.0;  // in one pair
  double fallbacks = 0.0;   // contacts whose answer is not the regular one
};

/** Tells whether neighbour lists, or grains between two runs, have changed since it was asked last. All ranks alike. */
class NeighbourListWatch {
 public:
  bool renewed(const LAMMPS_NS::Neighbor &neighbor, const LAMMPS_NS::Update &update) {
    if (neighbor.ago != 0 && built_ == neighbor.lastcall && run_ == update.firststep) return false;
    built_ = neighbor.lastcall;
    run_ = update.firststep;
    return true;
  }

 private:
  LAMMPS_NS::bigint built_ = -1, run_ = -1;
};

/** Every owned and ghost grain as an ellipsoid: shapes are read once per neighbour list and run, orientations once per
 *  force evaluation. */
class EllipsoidBodies : private LAMMPS_NS::Pointers {
 public:
  explicit EllipsoidBodies(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  /** Before a force evaluation; all ranks together. Refuses grains that are no ellipsoids, or no spheres where a model
   *  needs spheres. */
  void prepare();
  /** A loop that finds the axes of grains itself says no. */
  void set_wants_axes(bool wants) { wants_axes_ = wants; }
  /** The words of a contact model that knows spheres only, or "". */
  void set_sphere_model(const std::string &model) { sphere_model_ = model; }

  /** Grains i and j, d = x_j - x_i, and a start as in ellipsoid_contact(). */
  struct Query {
    int i, j;
    double d[3], start;
  };
  EllipsoidContact solve(const Query &query);
  /** At a point y of the surface of grain i, from its centre [1/length]. */
  double mean_curvature(int i, const double y[3]) const;
  /** Of the sphere of equal volume. */
  double equivalent_radius(int i) const { return grains_[i].equivalent_radius; }
  bool only_spheres() const { return only_spheres_; }
  bool some_spheres() const { return some_spheres_; }
  bool some_triaxial() const { return some_triaxial_; }
  /** Two grains that are what the lanes of meet_spheroids() are for, or those of meet_round(). */
  bool in_lanes(int i, int j) const {
    return only_spheres_ || (!grains_[i].triaxial && !grains_[j].triaxial && !(is_sphere(i) && is_sphere(j)));
  }
  /** Of a spheroid, or a sphere; its axis is there where prepare() was asked for it. */
  const Spheroid &spheroid(int i) const { return grains_[i].spheroid; }
  /** The body axis that is the symmetry axis; of spheres, any. */
  int symmetry(int i) const { return grains_[i].axis; }
  bool is_sphere(int i) const { return grains_[i].elongation == 0.0; }
  /** Difference of the largest and the smallest semi-axis. */
  double elongation(int i) const { return grains_[i].elongation; }

  SolverCounts counts;
  /** Adds to them what was done in lanes: a pair, or many. */
  void count(bool touching, double steps);
  void count(const SolverTally &tally);

 private:
  struct Grain {
    Spheroid spheroid;
    double equivalent_radius, elongation;
    int axis;
    bool triaxial;
  };
  std::vector<Grain> grains_;
  bool wants_axes_ = true;
  bool only_spheres_ = false, some_spheres_ = false, some_triaxial_ = false;
  NeighbourListWatch lists_;
  bool warned_ = false;
  std::string sphere_model_;

  void read_shapes(int n);
  void refuse_other_blockiness();
  void refuse_other_than_spheres();
  Triaxial frame(int i) const;
  Spheroid turned(int i) const;
  EllipsoidContact solve_alone(const Query &query) const;
  void count(const Query &query, EllipsoidContact &contact);
};

}

#endif

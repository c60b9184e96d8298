// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ELLIPSOID_BODIES_H
#define GRAINSCOPE_ELLIPSOID_BODIES_H

#include "ellipsoid_contact.h"
#include "pointers.h"
#include <vector>

namespace grainscope {

/** What the solver did on this rank, since the pair style was defined. */
struct SolverCounts {
  double listed = 0.0;     // pairs in neighbour lists, once per force evaluation (own loop only)
  double solved = 0.0;     // pairs that the solver was asked for
  double touching = 0.0;
  double steps = 0.0;      // Newton steps
  double most_steps = 0.0; // in one pair
  double fallbacks = 0.0;  // contacts whose answer is not the regular one
};

/** Every owned and ghost grain as an ellipsoid: shapes are read once per neighbour list, orientations once per force evaluation. */
class EllipsoidBodies : private LAMMPS_NS::Pointers {
 public:
  explicit EllipsoidBodies(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  /** Before a force evaluation; all ranks together. Refuses grains that are no ellipsoids. */
  void prepare();

  /** Grains i and j, d = x_j - x_i, and a start as in ellipsoid_contact(). */
  struct Query { int i, j; double d[3], start; };
  void solve(int n, const Query *queries, EllipsoidContact *contacts);
  /** At a point y of the surface of grain i, from its centre [1/length]. */
  double mean_curvature(int i, const double y[3]) const;
  /** Of the sphere of equal volume. */
  double equivalent_radius(int i) const { return grains_[i].equivalent_radius; }
  bool is_sphere(int i) const { return grains_[i].elongation == 0.0; }
  /** Difference of the largest and the smallest semi-axis. */
  double elongation(int i) const { return grains_[i].elongation; }

  SolverCounts counts;

 private:
  struct Grain {
    Spheroid spheroid;
    double equivalent_radius, elongation;
    int axis;
    bool triaxial;
  };
  std::vector<Grain> grains_;
  std::vector<Triaxial> frames_;  // of all grains, if one of them is triaxial
  LAMMPS_NS::bigint list_ = -1;
  std::vector<EllipsoidPair> pairs_;
  bool warned_ = false;

  void read_shapes(int n);
  void refuse_other_blockiness();
  void count(const Query &query, const EllipsoidContact &contact);
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ELLIPSOID_BODIES_H
#define GRAINSCOPE_ELLIPSOID_BODIES_H

#include "ellipsoid_contact.h"
#include "neighbour_list_watch.h"
#include "pair_group.h"
#include "pointers.h"
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

/** Every owned and ghost grain as an ellipsoid: shapes are read once per neighbour list and run, orientations once per
 *  force evaluation, or when a pair asks for them. */
class EllipsoidBodies : private LAMMPS_NS::Pointers {
 public:
  explicit EllipsoidBodies(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  /** Before a force evaluation; all ranks together. Refuses grains that are not ellipsoids, or not spheres if a model
   *  needs spheres. */
  void prepare();
  /** A loop that asks for few pairs says no. */
  void set_keeps_turned(bool keeps) { keeps_turned_ = keeps; }
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
  double equivalent_radius(int i) const { return shape(i).equivalent_radius; }
  /** All grains are alike but for place, orientation and motion. */
  bool one_shape() const { return one_shape_; }
  bool only_spheres() const { return only_spheres_; }
  bool some_spheres() const { return some_spheres_; }
  bool some_triaxial() const { return some_triaxial_; }
  /** Two grains that are what the lanes of meet_spheroids() are for, or those of meet_round(). */
  bool in_lanes(int i, int j) const {
    return only_spheres_ || (!is_triaxial(i) && !is_triaxial(j) && !(is_sphere(i) && is_sphere(j)));
  }
  /** Of a spheroid, or a sphere, but for its axis. */
  const Spheroid &spheroid(int i) const { return shape(i).spheroid; }
  /** The body axis that is the symmetry axis; of spheres, any. */
  int symmetry(int i) const { return shape(i).axis; }
  bool is_sphere(int i) const { return shape(i).elongation == 0.0; }
  bool is_triaxial(int i) const { return shape(i).triaxial; }
  /** For SeparationMemory. A turn by phi brings a surface nearer by at most the elongation times phi; it changes an
   *  axis by phi, a quaternion by phi/2. */
  double turn_slope(int i) const { return shape(i).elongation * (is_triaxial(i) ? 2.0 : 1.0); }

  SolverCounts counts;
  /** Adds to them what was done in lanes: a pair, or many. */
  void count(bool touching, double steps);
  void count(const SolverTally &tally);

 private:
  struct Shape {
    Spheroid spheroid;
    double equivalent_radius, elongation;  // the largest less the smallest semi-axis
    int axis;
    bool triaxial;
  };
  std::vector<Shape> shapes_;     // one, if it is that of all
  std::vector<Spheroid> turned_;  // as they are now, of each grain, where they are kept
  bool keeps_turned_ = true;
  bool one_shape_ = false;
  bool only_spheres_ = false, some_spheres_ = false, some_triaxial_ = false;
  NeighbourListWatch lists_;
  bool warned_ = false;
  std::string sphere_model_;

  const Shape &shape(int i) const { return shapes_[one_shape_ ? 0 : i]; }
  Shape shape_of(int i) const;
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

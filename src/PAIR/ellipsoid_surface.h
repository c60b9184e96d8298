// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ELLIPSOID_SURFACE_H
#define GRAINSCOPE_ELLIPSOID_SURFACE_H

#include "ellipsoid_bodies.h"
#include "superquadric_columns.h"
#include "atom.h"
#include "contact_interface.h"
#include <Eigen/Geometry>
#include <algorithm>

namespace grainscope {

/** What `surface ellipsoid` does between the solver and the contact data and history of LIGGGHTS, for all loops. */
struct EllipsoidSurface {
  // Column of the contact history, before those of all other models: lambda less 1/2, so that it changes sign when
  // LIGGGHTS swaps i and j; 0: none. In restart files it is the last column of `surface superquadric`: the value of the
  // other surface is a valid start or no start, never a wrong one.
  static constexpr int lambda = 0;
  double curvature_limit = 0.0;
  bool mean = false, gaussian = false;

  using SurfaceData = LIGGGHTS::ContactModels::SurfacesIntersectData;

  double start(const double *history) const { return history[lambda] == 0.0 ? 0.0 : history[lambda] + 0.5; }

  /** The pair does not touch. */
  void forget(double *history) const {
    if (history[lambda] != 0.0) history[lambda] = 0.0;
  }

  /** Enters a contact into the history, and into `s` if it touches; else s.deltan is minus a lower bound of the
   *  distance. */
  inline __attribute__((always_inline)) bool enter(const EllipsoidContact &c, SurfaceData &s,
                                                   const EllipsoidBodies &bodies, const LAMMPS_NS::Atom *atom) const {
    if (!c.touching) {
      forget(s.contact_history);
      s.deltan = -c.gap;
      return false;
    }
    // Two spheres take the models' shorter formulas, but where a limit makes them softer than spheres.
    s.is_non_spherical =
        !bodies.is_sphere(s.i) || !bodies.is_sphere(s.j) || (curvature_limit > 0.0 && curvature_limit < 1.0);
    s.reff = s.radi * s.radj / (s.radi + s.radj);
    if (curvature_limit > 0.0 && s.is_non_spherical) {
      double ki = c.curvature[0], kj = c.curvature[1];
      if (mean) {
        double on_i[3], on_j[3];
        for (int k = 0; k < 3; k++) {
          on_i[k] = c.point[k] + c.depth[0] * c.normal[k];
          on_j[k] = c.point[k] + s.delta[k] - c.depth[1] * c.normal[k];
        }
        ki = bodies.mean_curvature(s.i, on_i);
        kj = bodies.mean_curvature(s.j, on_j);
      }
      s.reff = std::min(1.0 / (ki + kj), s.reff * curvature_limit);
    }
    s.deltan = c.depth[0] + c.depth[1];
    for (int k = 0; k < 3; k++) {
      s.en[k] = -c.normal[k];
      s.contact_point[k] = atom->x[s.i][k] + c.point[k];
    }
    if (s.is_non_spherical) {
      s.contact_history[lambda] = c.lambda - 0.5;
    } else {
      s.cri = s.radi - c.depth[0];
      s.crj = s.radj - c.depth[1];
    }
    return true;
  }

  /** The columns of `surface superquadric` for compute pair/gran/local: 0 (the axis that separates the bounding boxes),
   *  2 (the grains touch), contact point, depth of i, depth of j. */
  static void show(const EllipsoidContact &c, const SurfaceData &s, double *columns) {
    const double *p = s.contact_point;
    const double values[SuperquadricColumns::count] = {0.0, 2.0, p[0], p[1], p[2], c.depth[0], c.depth[1]};
    std::copy(values, values + SuperquadricColumns::count, columns);
  }

  /** Velocities of i against j at the contact point, and its distances from the centres (of spheres entered
   *  already). */
  void move(SurfaceData &s, const LAMMPS_NS::Atom *atom) const {
    using Vector = Eigen::Map<const Eigen::Vector3d>;
    const Vector normal(s.en), point(s.contact_point), spin_i(s.omega_i), spin_j(s.omega_j);
    const Eigen::Vector3d arm_i = point - Vector(atom->x[s.i]), arm_j = point - Vector(atom->x[s.j]);
    const Eigen::Vector3d v = Vector(s.v_i) - Vector(s.v_j) + spin_i.cross(arm_i) - spin_j.cross(arm_j);
    s.vn = v.dot(normal);
    s.vtr1 = v[0] - s.vn * normal[0];
    s.vtr2 = v[1] - s.vn * normal[1];
    s.vtr3 = v[2] - s.vn * normal[2];
    s.wr1 = spin_i[0] - spin_j[0];
    s.wr2 = spin_i[1] - spin_j[1];
    s.wr3 = spin_i[2] - spin_j[2];
    if (!s.is_non_spherical) return;
    s.cri = arm_i.norm();
    s.crj = arm_j.norm();
  }
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_GRAIN_SHAPE_H
#define GRAINSCOPE_GRAIN_SHAPE_H

#include "superquadric_volume.h"
#include "atom.h"
#include <Eigen/Geometry>
#include <cmath>

namespace grainscope {

/** Mass of grain i, its own or that of its type. */
inline double mass_of(const LAMMPS_NS::Atom &atom, int i) {
  return atom.rmass ? atom.rmass[i] : atom.mass[atom.type[i]];
}

/** Semi-axes of grain i: those of a superquadric, for a sphere its radius, three times. */
inline Eigen::Vector3d semi_axes(const LAMMPS_NS::Atom &atom, int i) {
  if (atom.superquadric_flag) return Eigen::Map<const Eigen::Vector3d>(atom.shape[i]);
  return Eigen::Vector3d::Constant(atom.radius[i]);
}

/** What grain i fills over what an ellipsoid, or sphere, of its semi-axes fills: 1 but for blocky superquadrics. */
inline double fullness(const LAMMPS_NS::Atom &atom, int i) {
  if (!atom.superquadric_flag) return 1.0;
  const double *n = atom.blockiness[i];
  return superquadric_volume(1.0, 1.0, 1.0, n[0], n[1]) / superquadric_volume(1.0, 1.0, 1.0, 2.0, 2.0);
}

/** Volume of grain i; with `dimension 2` the area of a disc. */
inline double solid_volume(const LAMMPS_NS::Atom &atom, int i, int dimension) {
  if (dimension == 2) return M_PI * atom.radius[i] * atom.radius[i];
  return 4.0 / 3.0 * M_PI * semi_axes(atom, i).prod() * fullness(atom, i);
}

/** Diameter of the sphere of the grain's volume. */
inline double equivalent_diameter(const LAMMPS_NS::Atom &atom, int i) {
  return 2.0 * std::cbrt(semi_axes(atom, i).prod() * fullness(atom, i));
}

/** Turns the frame of the principal axes of superquadric i into the laboratory's. */
inline Eigen::Quaterniond orientation(const LAMMPS_NS::Atom &atom, int i) {
  const double *q = atom.quaternion[i];
  return {q[0], q[1], q[2], q[3]};
}

/** Moment of inertia over m r^2 of grains that are no superquadrics, as fix nve/sphere turns them: a sphere's, or with
 *  `dimension 2` a disc's. */
inline double inertia_factor(int dimension) { return dimension == 2 ? 0.5 : 0.4; }
inline double moment_of_inertia(const LAMMPS_NS::Atom &atom, int i, int dimension) {
  return inertia_factor(dimension) * atom.rmass[i] * atom.radius[i] * atom.radius[i];
}

/** Inertia tensor in the laboratory frame. */
inline Eigen::Matrix3d inertia_tensor(const LAMMPS_NS::Atom &atom, int i, int dimension) {
  if (!atom.superquadric_flag) return moment_of_inertia(atom, i, dimension) * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d r = orientation(atom, i).toRotationMatrix();
  return r * Eigen::Map<const Eigen::Vector3d>(atom.inertia[i]).asDiagonal() * r.transpose();
}

/** 1/2 w.J w, J the inertia tensor of grain i and w in the laboratory frame. */
inline double rotational_energy(const LAMMPS_NS::Atom &atom, int i, int dimension, const Eigen::Vector3d &w) {
  if (!atom.superquadric_flag) return 0.5 * moment_of_inertia(atom, i, dimension) * w.squaredNorm();
  const Eigen::Vector3d body = orientation(atom, i).conjugate() * w;
  return 0.5 * body.cwiseAbs2().dot(Eigen::Map<const Eigen::Vector3d>(atom.inertia[i]));
}

}

#endif

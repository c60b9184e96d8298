// SPDX-License-Identifier: GPL-2.0-or-later
#include "box_state.h"
#include "bin_index.h"
#include "domain.h"
#include "lammps.h"
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace grainscope {

Eigen::Matrix3d upper_triangular(const double *h) {
  Eigen::Matrix3d m;
  m << h[0], h[5], h[4], 0.0, h[1], h[3], 0.0, 0.0, h[2];
  return m;
}

BoxState::BoxState(LAMMPS_NS::LAMMPS *lmp) {
  const LAMMPS_NS::Domain *domain = lmp->domain;
  const double h[6] = {domain->xprd,
                       domain->yprd,
                       domain->zprd,
                       domain->triclinic ? domain->yz : 0.0,
                       domain->triclinic ? domain->xz : 0.0,
                       domain->triclinic ? domain->xy : 0.0};
  dimension = domain->dimension;
  edges = upper_triangular(h);
  const Eigen::Map<const Eigen::Vector3d> corner(domain->boxlo);
  cell_centre = corner + 0.5 * edges.rowwise().sum();
  centre = corner + 0.5 * edges.diagonal();
  if (dimension == 2) edges(2, 2) = 1.0;
  // With `remap x` LIGGGHTS moves grains along with the box without a change of their velocities, which are therefore
  // peculiar.
  if (domain->deform_vremap) edge_velocities = upper_triangular(domain->h_rate);
  velocity_gradient = edge_velocities * edges.inverse();
  volume = edges(0, 0) * edges(1, 1) * edges(2, 2);
  periodic = {{domain->xperiodic != 0, domain->yperiodic != 0, domain->zperiodic != 0 && dimension == 3}};
}

Eigen::Vector3d BoxState::fraction(const Eigen::Vector3d &x) const {
  return edges.triangularView<Eigen::Upper>().solve(x - cell_centre) + Eigen::Vector3d::Constant(0.5);
}

int BoxState::layer(const Eigen::Vector3d &x, int k, int layers) const {
  const double s = fraction(x)[k];
  return nearest_bin_index((periodic[k] ? s - std::floor(s) : s) * layers, layers);
}

double BoxState::height(int k) const { return volume / edges.col((k + 1) % 3).cross(edges.col((k + 2) % 3)).norm(); }

}

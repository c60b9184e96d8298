// SPDX-License-Identifier: GPL-2.0-or-later
#include "periodic_cell.h"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace grainscope {

using Eigen::Vector3d;

double PeriodicCell::height(int k) const {
  const Vector3d normal = edges.col((k + 1) % 3).cross(edges.col((k + 2) % 3)).normalized();
  return std::fabs(normal.dot(edges.col(k)));
}

double PeriodicCell::rounding_radius() const {
  double smallest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; k++)
    if (periodic[k]) smallest = std::min(smallest, 0.5 * height(k));
  return smallest;
}

double PeriodicCell::nearest_squared(Vector3d separation) const {
  for (int k = 0; k < 3; k++)
    if (periodic[k]) separation[k] -= std::nearbyint(separation[k]);
  double nearest = (edges * separation).squaredNorm();
  if (nearest <= std::pow(rounding_radius(), 2)) return nearest;

  // Nothing nearer than d lies further than d/height along an edge.
  int from[3] = {}, to[3] = {};
  for (int k = 0; k < 3; k++) {
    if (!periodic[k]) continue;
    const double reach = std::sqrt(nearest) / height(k);
    from[k] = static_cast<int>(std::ceil(-reach - separation[k]));
    to[k] = static_cast<int>(std::floor(reach - separation[k]));
  }
  for (int a = from[0]; a <= to[0]; a++)
    for (int b = from[1]; b <= to[1]; b++)
      for (int c = from[2]; c <= to[2]; c++)
        nearest = std::min(nearest, (edges * (separation + Vector3d(a, b, c))).squaredNorm());
  return nearest;
}

}

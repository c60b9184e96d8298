// SPDX-License-Identifier: GPL-2.0-or-later
#include "periodic_cell.h"
#include "lanes.h"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace grainscope {

using Eigen::Vector3d;

namespace {

const int most_images = 1000000;  // along an edge: beyond what could be looked through

}

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

NearestImages::NearestImages(const PeriodicCell &cell, double range) {
  if (!(range > cell.rounding_radius())) return;
  const Eigen::Matrix3d metric = cell.edges.transpose() * cell.edges;
  Vector3d largest;  // components of a separation: rounded, or across the box and beyond
  for (int k = 0; k < 3; k++) largest[k] = cell.periodic[k] ? 0.5 : 1.5;
  const double longest = (cell.edges.cwiseAbs() * largest).norm();
  int most[3];
  for (int k = 0; k < 3; k++) {
    most[k] = cell.periodic[k] ? bin_index(2.0 * longest / cell.height(k), most_images) : 0;
    if (most[k] < 0)
      throw std::length_error("the box is so narrow or so tilted that its images cannot be distinguished");
  }
  for (int a = -most[0]; a <= most[0]; a++)
    for (int b = -most[1]; b <= most[1]; b++)
      for (int c = -most[2]; c <= most[2]; c++) {
        const Vector3d n(a, b, c), product = metric * n;
        // |H(s + n)|^2 - |H s|^2 = 2 s.product + n.product is least in a corner of all s.
        if (2.0 * largest.dot(product.cwiseAbs()) > n.dot(product) * (1.0 + 1e-12)) shifts_.push_back(cell.edges * n);
      }
}

GRAINSCOPE_CLONES void NearestImages::lower(int n, const double *x, const double *y, const double *z,
                                            double *r2) const {
  for (const Vector3d &shift : shifts_) {
    const double a = shift[0], b = shift[1], c = shift[2];
    for (int m = 0; m < n; m++) {
      const double other = (x[m] + a) * (x[m] + a) + (y[m] + b) * (y[m] + b) + (z[m] + c) * (z[m] + c);
      r2[m] = other < r2[m] ? other : r2[m];
    }
  }
}

}

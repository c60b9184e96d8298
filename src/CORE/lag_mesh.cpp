// SPDX-License-Identifier: GPL-2.0-or-later
#include "lag_mesh.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace grainscope {

using Eigen::Vector3d;

namespace {

const int most_along = 1 << 30;

std::string as_text(double cells) {
  char text[32];
  std::snprintf(text, sizeof text, std::fabs(cells) < 1e15 ? "%.0f" : "%g", cells);
  return text;
}

bool is_fast(int n) {
  for (int factor : {2, 3, 5, 7})
    while (n % factor == 0) n /= factor;
  return n == 1;
}

/** Lag m of n in units of the edge, in [-1/2, 1/2]. */
double fraction(std::ptrdiff_t m, int n) { return static_cast<double>(2 * m > n ? m - n : m) / n; }

}

int fast_length(int at_least) {
  int n = std::max(1, at_least);
  while (!is_fast(n)) n++;
  return n;
}

std::array<int, 3> mesh_size(const PeriodicCell &cell, const DistanceBins &bins, int per_bin, double most) {
  std::array<double, 3> wanted;
  // rounding must not add a cell
  for (int k = 0; k < 3; k++)
    wanted[k] = cell.periodic[k] ? std::ceil(per_bin * cell.height(k) / bins.width() - 1e-6) : 1.0;
  std::array<int, 3> size;
  bool too_many = !(wanted[0] * wanted[1] * wanted[2] <= most);
  for (int k = 0; k < 3; k++) {
    size[k] = bin_index(std::max(wanted[k], 0.0), most_along);
    too_many = too_many || size[k] < 0;
  }
  if (too_many) throw std::length_error(as_text(wanted[0]) + " x " + as_text(wanted[1]) + " x " + as_text(wanted[2]));
  for (int &cells : size) cells = fast_length(cells);
  return size;
}

std::array<int, 3> LagMesh::cell_of(const PointValues &points, std::size_t i) const {
  std::array<int, 3> cell;
  for (int k = 0; k < 3; k++) cell[k] = cell_along(points.s[k][i] - std::floor(points.s[k][i]), size[k]);
  return cell;
}

void add_lags(const PeriodicCell &cell, const LagMesh &mesh, const double *correlation, bool whole,
              const DistanceBins &bins, std::vector<double> &sums) {
  const NearestImages images(cell, bins.range);
  const double range2 = bins.range * bins.range, per_length = 1.0 / bins.width();
  const int n = mesh.size[2];
  std::vector<double> along(n), x(n), y(n), z(n), r2(n);
  for (int c = 0; c < n; c++) along[c] = fraction(c, n);
  for (std::ptrdiff_t plane = 0; plane < mesh.planes; plane++)
    for (int b = 0; b < mesh.size[1]; b++) {
      const Vector3d from =
          cell.edges * Vector3d(fraction(mesh.first_plane + plane, mesh.size[0]), fraction(b, mesh.size[1]), 0.0);
      for (int c = 0; c < n; c++) {
        x[c] = from[0] + along[c] * cell.edges(0, 2);
        y[c] = from[1] + along[c] * cell.edges(1, 2);
        z[c] = along[c] * cell.edges(2, 2);
        r2[c] = x[c] * x[c] + y[c] * y[c] + z[c] * z[c];
      }
      images.lower(n, x.data(), y.data(), z.data(), r2.data());
      const double *values = correlation + (plane * mesh.size[1] + b) * mesh.row;
      for (int c = 0; c < n; c++) {
        if (!(r2[c] < range2)) continue;
        const int bin = nearest_bin_index(std::sqrt(r2[c]) * per_length, bins.count);
        sums[bin] += whole ? std::nearbyint(values[c]) : values[c];
      }
    }
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "lag_mesh.h"
#include <gtest/gtest.h>
#include <cmath>
#include <stdexcept>

using Eigen::Vector3d;
using grainscope::add_lags;
using grainscope::DistanceBins;
using grainscope::LagMesh;
using grainscope::PeriodicCell;
using grainscope::PointValues;

namespace {

/** Length of the nearest image of a lag. */
double nearest(const PeriodicCell &cell, Vector3d s) {
  double least = 1e9;
  for (int k = 0; k < 125; k++)
    least = std::min(least, (cell.edges * (s - Vector3d(k % 5 - 1, k / 5 % 5 - 1, k / 25 - 1))).norm());
  return least;
}

PeriodicCell sheared() {
  PeriodicCell c;
  c.edges << 6.0, 2.0, -1.0, 0.0, 5.0, 1.5, 0.0, 0.0, 5.5;
  return c;
}

const LagMesh whole{{{12, 10, 9}}, 0, 12, 10};

}

TEST(lag_mesh, fast_lengths) {
  EXPECT_EQ(grainscope::fast_length(1), 1);
  EXPECT_EQ(grainscope::fast_length(11), 12);
  EXPECT_EQ(grainscope::fast_length(152), 160);
  EXPECT_EQ(grainscope::fast_length(343), 343);
}

TEST(lag_mesh, cells_follow_the_bins_and_refuse_to_be_too_many) {
  PeriodicCell cube;
  cube.edges *= 10.0;
  const std::array<int, 3> expected{{80, 80, 80}};
  EXPECT_EQ(grainscope::mesh_size(cube, {5.0, 10}, 4, 1e9), expected);
  cube.edges(1, 1) = 20.0;
  EXPECT_EQ(grainscope::mesh_size(cube, {5.0, 10}, 4, 1e9)[1], 160);
  EXPECT_THROW(grainscope::mesh_size(cube, {5.0, 10}, 4, 1e6), std::length_error);
}

TEST(lag_mesh, an_edge_across_the_plane_of_two_dimensions_is_not_divided) {
  PeriodicCell plane;
  plane.edges *= 10.0;
  plane.periodic[2] = false;
  const std::array<int, 3> expected{{80, 80, 1}};
  EXPECT_EQ(grainscope::mesh_size(plane, {5.0, 10}, 4, 1e9), expected);
}

TEST(lag_mesh, points_fall_into_cells_wherever_their_image_is) {
  PointValues p;
  p.add({0.99, -0.01, 1.5}, 0.0);
  p.add({-1e-18, 0.0, 1.0}, 0.0);
  const std::array<int, 3> first{{11, 9, 4}}, second{{11, 0, 0}};
  EXPECT_EQ(whole.cell_of(p, 0), first);
  EXPECT_EQ(whole.cell_of(p, 1), second);  // 1 - 1e-18 is 1: still a cell of the mesh
}

TEST(lag_mesh, every_lag_goes_to_the_bin_of_its_nearest_image) {
  const PeriodicCell cell = sheared();
  for (double range : {cell.rounding_radius(), 3.9}) {
    const DistanceBins bins{range, 8};
    // the padding must not be read
    std::vector<double> field(12 * 10 * whole.row, 1e9), expected(8, 0.0), found(8, 0.0);
    for (int a = 0; a < 12; a++)
      for (int b = 0; b < 10; b++)
        for (int c = 0; c < 9; c++) {
          field[(a * 10 + b) * whole.row + c] = a + 100.0 * b + 0.01 * c;
          const double r = nearest(cell, {a / 12.0, b / 10.0, c / 9.0});
          if (r < range) expected[static_cast<int>(r / bins.width())] += a + 100.0 * b + 0.01 * c;
        }
    add_lags(cell, whole, field.data(), false, bins, found);
    for (int k = 0; k < 8; k++) EXPECT_NEAR(found[k], expected[k], 1e-9) << range << ", bin " << k;
  }
}

TEST(lag_mesh, slabs_add_up_and_an_empty_one_adds_nothing) {
  const PeriodicCell cell = sheared();
  const DistanceBins bins{2.0, 4};
  std::vector<double> field(12 * 10 * whole.row);
  for (std::size_t k = 0; k < field.size(); k++) field[k] = std::sin(static_cast<double>(k));
  std::vector<double> all(4, 0.0), parts(4, 0.0);
  add_lags(cell, whole, field.data(), false, bins, all);
  for (const LagMesh &slab :
       {LagMesh{{{12, 10, 9}}, 0, 5, 10}, LagMesh{{{12, 10, 9}}, 5, 7, 10}, LagMesh{{{12, 10, 9}}, 0, 0, 10}})
    add_lags(cell, slab, field.data() + slab.first_plane * 10 * slab.row, false, bins, parts);
  for (int k = 0; k < 4; k++) EXPECT_NEAR(parts[k], all[k], 1e-13);
}

TEST(lag_mesh, counts_are_rounded_lag_by_lag) {
  const PeriodicCell cell = sheared();
  std::vector<double> field(12 * 10 * whole.row, 0.4), found(1, 0.0);
  field[0] = 2.9;
  add_lags(cell, whole, field.data(), true, {2.0, 1}, found);
  EXPECT_EQ(found[0], 3.0);
}

TEST(lag_mesh, what_is_no_place_or_no_box_does_no_harm) {
  PointValues points;
  for (double where : {-1e-17, 1e150, HUGE_VAL, std::nan("")}) points.add(Vector3d(where, 0.5, 0.5), 1.0);
  for (std::size_t i = 0; i < points.size(); i++) {
    const int cell = whole.cell_of(points, i)[0];
    if (std::isfinite(points.s[0][i])) {
      EXPECT_TRUE(cell >= 0 && cell < 12) << cell;
    } else {
      EXPECT_EQ(cell, -1);
    }
  }
  PeriodicCell torn = sheared();
  torn.edges *= std::nan("");
  std::vector<double> field(12 * 10 * whole.row, 1.0), found(1, 0.0);
  add_lags(torn, whole, field.data(), true, {2.0, 1}, found);
  EXPECT_EQ(found[0], 0.0);
  EXPECT_THROW(grainscope::mesh_size(torn, {2.0, 1}, 4, 1e9), std::length_error);
}

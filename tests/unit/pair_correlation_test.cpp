// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_correlation.h"
#include <gtest/gtest.h>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

using Eigen::Matrix3d;
using Eigen::Vector3d;
using grainscope::direct_pair_sums;
using grainscope::DistanceBins;
using grainscope::PairSums;
using grainscope::PeriodicCell;
using grainscope::PointValues;

namespace {

PeriodicCell cell(double xx, double yy, double zz, double yz = 0.0, double xz = 0.0, double xy = 0.0) {
  PeriodicCell c;
  c.edges << xx, xy, xz, 0.0, yy, yz, 0.0, 0.0, zz;
  return c;
}

PointValues random_points(int n, double from = 0.0, double to = 1.0) {
  std::mt19937 generator(4711);
  std::uniform_real_distribution<double> s(from, to), value(-1.0, 1.0);
  PointValues points;
  for (int i = 0; i < n; i++) {
    const double x = s(generator), y = s(generator), z = s(generator);
    points.add({x, y, z}, value(generator));
  }
  return points;
}

Vector3d position(const PointValues &p, std::size_t i) { return {p.s[0][i], p.s[1][i], p.s[2][i]}; }

/** Nearest of the images that lie within `reach` cells of the rounded separation. */
double nearest(const PeriodicCell &c, Vector3d s, int reach = 1) {
  for (int k = 0; k < 3; k++)
    if (c.periodic[k]) s[k] -= std::round(s[k]);
  double least = std::numeric_limits<double>::infinity();
  for (int x = -reach; x <= reach; x++)
    for (int y = -reach; y <= reach; y++)
      for (int z = -reach; z <= reach; z++) {
        if ((x && !c.periodic[0]) || (y && !c.periodic[1]) || (z && !c.periodic[2])) continue;
        least = std::min(least, (c.edges * (s + Vector3d(x, y, z))).norm());
      }
  return least;
}

PairSums brute_force(const PeriodicCell &c, const PointValues &p, const DistanceBins &bins, int reach = 1) {
  PairSums sums(bins.count);
  for (std::size_t i = 0; i < p.size(); i++)
    for (std::size_t j = 0; j < i; j++) {
      const double r = nearest(c, position(p, i) - position(p, j), reach);
      if (r >= bins.range) continue;
      sums.products[0][static_cast<int>(r / bins.width())] += p.values[0][i] * p.values[0][j];
      sums.pairs[static_cast<int>(r / bins.width())] += 1.0;
    }
  return sums;
}

void expect_equal(const PairSums &found, const PairSums &expected, const std::string &what) {
  for (std::size_t k = 0; k < expected.pairs.size(); k++) {
    EXPECT_EQ(found.pairs[k], expected.pairs[k]) << what << ", bin " << k;
    // sums of some thousand terms below 1
    EXPECT_NEAR(found.products[0][k], expected.products[0][k], 1e-11) << what << ", bin " << k;
  }
}

double half_height(const PeriodicCell &c) { return 0.5 * std::min({c.height(0), c.height(1), c.height(2)}); }

const PeriodicCell sheared = cell(7.0, 8.0, 6.5, -2.0, 1.1, 3.4);

}

TEST(periodic_cell, heights_of_a_sheared_cell) {
  const PeriodicCell c = cell(4.0, 3.0, 2.0, 0.0, 0.0, 4.0);
  EXPECT_NEAR(c.height(0), 4.0 * 3.0 / 5.0, 1e-15);  // between planes along (4, 3) and z
  EXPECT_NEAR(c.height(1), 3.0, 1e-15);
  EXPECT_NEAR(c.height(2), 2.0, 1e-15);
  EXPECT_NEAR(c.rounding_radius(), 1.0, 1e-15);
}

TEST(periodic_cell, nearest_image_at_any_distance) {
  const PointValues p = random_points(500, -0.5, 0.5);
  // In the flat cell, which leans over by more than its height, they are up to three cells away.
  for (const PeriodicCell &c :
       {sheared, cell(7.0, 8.0, 6.5), cell(10.0, 1.0, 3.0, 0.3, 2.0, 4.9), cell(5.0, 5.0, 5.0, 2.5, -2.5, 2.5)}) {
    const grainscope::NearestImages images(c, 100.0);
    for (std::size_t i = 0; i < p.size(); i++) {
      const Vector3d d = c.edges * position(p, i);
      double r2 = d.squaredNorm();
      images.lower(1, &d[0], &d[1], &d[2], &r2);
      EXPECT_NEAR(std::sqrt(r2), nearest(c, position(p, i), 6), 1e-14);
    }
  }
}

TEST(direct_pair_sums, two_points_across_a_sheared_face) {
  // 0.1 below the top face and 0.1 above the bottom one, which the shear moves by 1.5 along x.
  const PeriodicCell c = cell(4.0, 4.0, 4.0, 0.0, 0.0, 1.5);
  PointValues p;
  p.add(c.edges.inverse() * Vector3d(1.5 + 0.3, 3.9, 1.0), 2.0);
  p.add(c.edges.inverse() * Vector3d(0.0, 0.1, 1.0), -3.0);
  const double r = std::sqrt(0.3 * 0.3 + 0.2 * 0.2);
  const PairSums sums = direct_pair_sums(c, p, {1.0, 10});
  for (int k = 0; k < 10; k++) {
    EXPECT_EQ(sums.pairs[k], k == static_cast<int>(10.0 * r) ? 1.0 : 0.0);
    EXPECT_NEAR(sums.products[0][k], k == static_cast<int>(10.0 * r) ? -6.0 : 0.0, 1e-15);
  }
}

TEST(direct_pair_sums, neighbour_shells_of_a_cubic_lattice) {
  PointValues p;
  for (int k = 0; k < 512; k++) p.add(Vector3d(k % 8, k / 8 % 8, k / 64) / 8.0, 1.0);
  const PairSums sums = direct_pair_sums(cell(8.0, 8.0, 8.0), p, {2.3, 23});  // bins of 0.1
  const double shells[][2] = {
      {1.0, 6.0}, {std::sqrt(2.0), 12.0}, {std::sqrt(3.0), 8.0}, {2.0, 6.0}, {std::sqrt(5.0), 24.0}};
  double found = 0.0;
  for (const auto &shell : shells) {
    const int bin = static_cast<int>(shell[0] / 0.1 + 1e-9);
    // either side of an edge
    const double pairs = sums.pairs[bin] + (std::fabs(shell[0] / 0.1 - bin) < 1e-6 ? sums.pairs[bin - 1] : 0.0);
    EXPECT_EQ(pairs, 256.0 * shell[1]) << shell[0];
    found += pairs;
  }
  double all = 0.0;
  for (double pairs : sums.pairs) all += pairs;
  EXPECT_EQ(all, found);
}

TEST(direct_pair_sums, are_those_of_27_images) {
  const PointValues p = random_points(300, -0.2, 1.3);  // some outside the cell
  const double half = half_height(sheared);
  expect_equal(direct_pair_sums(sheared, p, {half, 19}), brute_force(sheared, p, {half, 19}), "half the box");
  expect_equal(direct_pair_sums(sheared, p, {1.7 * half, 7}), brute_force(sheared, p, {1.7 * half, 7}),
               "beyond half the box");
}

TEST(direct_pair_sums, short_ranges_are_sorted_into_cells_and_lose_no_pair) {
  const PointValues p = random_points(1000, -0.2, 1.3);
  for (const PeriodicCell &c : {sheared, cell(40.0, 8.0, 6.5, 1.0, 3.0, 17.0)})
    for (double part : {0.05, 0.2, 0.45, 0.8}) {
      const DistanceBins bins{part * half_height(c), 5};
      expect_equal(direct_pair_sums(c, p, bins), brute_force(c, p, bins), std::to_string(part));
    }
}

TEST(direct_pair_sums, edges_that_do_not_repeat) {
  PeriodicCell c = cell(9.0, 8.0, 30.0, 0.0, 0.0, 4.4);
  c.periodic = {{true, false, false}};
  const PointValues p = random_points(900, -0.1, 1.1);
  for (double range : {0.7, 3.0, 12.0, 30.0})
    expect_equal(direct_pair_sums(c, p, {range, 6}), brute_force(c, p, {range, 6}), std::to_string(range));
}

TEST(direct_pair_sums, any_number_of_points_in_any_box) {
  std::mt19937 generator(1908);
  std::uniform_real_distribution<double> edge(3.0, 12.0), tilt(-0.5, 0.5), part(0.1, 1.0);
  for (int n : {2, 3, 5, 7, 8, 9, 15, 16, 17, 31, 63, 129, 257})
    for (int edges = 0; edges < 8; edges++) {
      const double x = edge(generator), y = edge(generator), z = edge(generator);
      PeriodicCell c = cell(x, y, z, tilt(generator) * y, tilt(generator) * x, tilt(generator) * x);
      for (int k = 0; k < 3; k++) c.periodic[k] = !(edges >> k & 1);
      for (double reach : {part(generator), 1.0, 1.0 + part(generator)}) {
        const PointValues p = random_points(n, -0.3, 1.2);
        const DistanceBins bins{reach * half_height(c), 1 + n % 23};
        expect_equal(direct_pair_sums(c, p, bins), brute_force(c, p, bins, 2),
                     std::to_string(n) + " points, edges " + std::to_string(edges));
      }
    }
}

TEST(direct_pair_sums, long_boxes_at_any_range) {
  const PointValues p = random_points(701, -0.2, 1.3);
  for (const PeriodicCell &c : {cell(30.0, 3.0, 4.0, 0.4, 1.0, 1.5), cell(3.0, 4.0, 90.0, -1.0, 0.7, 1.5)})
    for (double range : {0.4, 1.4, 2.5, 6.0})
      expect_equal(direct_pair_sums(c, p, {range, 11}), brute_force(c, p, {range, 11}, 2), std::to_string(range));
}

TEST(direct_pair_sums, layer_of_two_dimensions) {
  PeriodicCell c = cell(9.0, 7.0, 9.0, 0.0, 0.0, 4.4);
  c.periodic[2] = false;
  PointValues p = random_points(801);
  std::fill(p.s[2].begin(), p.s[2].end(), 0.0);
  for (double part : {0.1, 0.5, 1.0, 1.5}) {
    const DistanceBins bins{part * half_height(c), 19};
    expect_equal(direct_pair_sums(c, p, bins), brute_force(c, p, bins), std::to_string(part));
  }
}

/** Half a box away a point has images on both sides: at the end of the range, which neither is within. */
TEST(direct_pair_sums, images_at_the_end_of_the_range) {
  for (double size : {0.7, 1.0 / 3.0, 9.1}) {
    PointValues p;
    for (int k = 0; k < 216; k++) p.add((Vector3d(k % 6, k / 6 % 6, k / 36) + Vector3d::Constant(0.1)) / 6.0, 1.0);
    double found = 0.0;
    for (double pairs : direct_pair_sums(cell(size, size, size), p, {0.5 * size, 7}).pairs) found += pairs;
    // neighbours whose squared distance in units of the lattice is 1, 2, 3, 4, 5, 6, 8; 9 is half the box
    EXPECT_EQ(found, 108.0 * (6 + 12 + 8 + 6 + 24 + 24 + 12)) << size;
  }
}

TEST(direct_pair_sums, shares_of_the_ranks_add_up) {
  const PointValues p = random_points(701);
  for (double part : {0.3, 1.0, 1.6}) {
    const DistanceBins bins{part * half_height(sheared), 9};
    PairSums sum(bins.count);
    for (int rank = 0; rank < 4; rank++) {
      const PairSums share = direct_pair_sums(sheared, p, bins, rank, 4);
      for (int k = 0; k < bins.count; k++) {
        sum.products[0][k] += share.products[0][k];
        sum.pairs[k] += share.pairs[k];
      }
    }
    expect_equal(sum, direct_pair_sums(sheared, p, bins), "four ranks");
  }
}

/** Within half the box, and beyond, where pairs are found in another way. */
TEST(direct_pair_sums, sets_of_values_are_added_up_as_if_each_were_alone) {
  const PointValues one = random_points(701), other = random_points(701 * 3);
  PointValues all = one;
  for (int n : {1, 2}) all.values.emplace_back(&other.values[0][701 * n], &other.values[0][701 * n] + 701);
  for (double part : {0.3, 1.0, 1.6}) {
    const DistanceBins bins{part * half_height(sheared), 9};
    const PairSums together = direct_pair_sums(sheared, all, bins);
    ASSERT_EQ(together.products.size(), 3u);
    for (int n = 0; n < 3; n++) {
      PointValues alone = one;
      alone.values = {all.values[n]};
      const PairSums sums = direct_pair_sums(sheared, alone, bins);
      EXPECT_EQ(sums.products[0], together.products[n]) << part << ", set " << n;
      EXPECT_EQ(sums.pairs, together.pairs);
    }
    EXPECT_NE(together.products[0], together.products[1]);
  }
}

TEST(direct_pair_sums, are_the_same_each_time) {
  const PointValues p = random_points(1000);
  const DistanceBins bins{half_height(sheared), 19};
  EXPECT_EQ(direct_pair_sums(sheared, p, bins).products, direct_pair_sums(sheared, p, bins).products);
}

TEST(direct_pair_sums, nothing_and_one_point_have_no_pairs) {
  for (int n : {0, 1}) {
    const PairSums sums = direct_pair_sums(sheared, random_points(n), {2.0, 3});
    EXPECT_EQ(sums.pairs, std::vector<double>(3, 0.0));
    EXPECT_EQ(sums.products[0], std::vector<double>(3, 0.0));
  }
}

/** Of a run that has blown up: a grain far out or nowhere, a box that is none. Whatever is not near is in no bin. */
TEST(direct_pair_sums, what_is_no_place_has_no_pairs) {
  for (int edge : {0, 2})  // a place far along the third edge is far along the others too, which that one leans over
    for (double where : {1e150, -1e150, 1e308, HUGE_VAL, std::nan("")}) {
      PeriodicCell c = cell(1.0, 1.0, 1.0, 0.2, 0.3, 0.3);
      c.periodic[edge] = false;
      PointValues points;
      points.add(Vector3d(0.5, 0.5, 0.5), 1.0);
      Vector3d stray(0.6, 0.6, 0.6);
      stray[edge] = where;
      points.add(stray, 1.0);
      EXPECT_EQ(direct_pair_sums(c, points, {0.5 * c.rounding_radius(), 3}).pairs, std::vector<double>(3, 0.0))
          << where << " along " << edge;
    }
  PeriodicCell torn;
  torn.edges *= std::nan("");
  PointValues points;
  for (double x : {0.1, 0.2}) points.add(Vector3d(x, 0.5, 0.5), 1.0);
  EXPECT_EQ(direct_pair_sums(torn, points, {std::nan(""), 3}).pairs, std::vector<double>(3, 0.0));
}

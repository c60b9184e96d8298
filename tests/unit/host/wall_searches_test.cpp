// SPDX-License-Identifier: GPL-2.0-or-later
#include "ellipsoid_pairs.h"
#include "plain_superquadric.h"
#include "superquadric.h"
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

namespace {

/** Of b, along a. */
void remove_part(const double *a, double *b) {
  const double part = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  for (int k = 0; k < 3; k++) b[k] -= part * a[k];
}

/** An ellipsoid, and a triangle with one edge or corner near its surface; sides from a hundredth to a hundred times the
 *  smallest semi-axis. */
struct GrainAndTriangle {
  double centre[3], quaternion[4], semi_axes[3], corners[3][3], normal[3];
  double *const rows[3] = {corners[0], corners[1], corners[2]};

  explicit GrainAndTriangle(RandomPairs &random) {
    random.direction(quaternion, 4);
    const bool spheroid = random.uniform() < 0.5;
    for (double &s : semi_axes) s = random.logarithmic(0.2, 5.0);
    if (spheroid) semi_axes[1] = semi_axes[0];
    double blockiness[2] = {2.0, 2.0}, outward[3], local[3];
    for (double &x : centre) x = 10.0 * random.normal();
    Superquadric grain(centre, quaternion, semi_axes, blockiness);
    // a point of the surface, moved outwards by a part of the radius or by next to nothing
    random.direction(outward, 3);
    const double apart = 1.0 + random.logarithmic(1e-12, 1.0) * (random.uniform() < 0.5 ? 1.0 : -0.5);
    for (int k = 0; k < 3; k++) local[k] = apart * semi_axes[k] * outward[k];
    double near[3], along[3], aside[3];
    grain.local2global(local, near);
    random.direction(along, 3);
    random.direction(aside, 3);
    double up[3], out[3];
    for (int k = 0; k < 3; k++) up[k] = outward[k] / semi_axes[k];
    grain.local2global(up, out);
    for (int k = 0; k < 3; k++) out[k] -= centre[k];
    const int tangential = static_cast<int>(random.uniform(0.0, 3.0));  // edges
    if (tangential > 0) remove_part(out, along);
    if (tangential > 1) remove_part(out, aside);
    const double length = random.logarithmic(0.01, 100.0), at = std::max(0.0, random.uniform(-0.2, 1.0));
    const double width = random.logarithmic(0.01, 100.0);
    for (int k = 0; k < 3; k++) {
      corners[0][k] = near[k] - at * length * along[k];
      corners[1][k] = near[k] + (1.0 - at) * length * along[k];
      corners[2][k] = near[k] + width * aside[k];
    }
    double one[3], other[3];
    for (int k = 0; k < 3; k++) {
      one[k] = corners[1][k] - corners[0][k];
      other[k] = corners[2][k] - corners[0][k];
    }
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
      normal[k] = one[(k + 1) % 3] * other[(k + 2) % 3] - one[(k + 2) % 3] * other[(k + 1) % 3];
      square += normal[k] * normal[k];
    }
    for (double &x : normal) x /= std::sqrt(square);
  }
};

void expect_same(const double *a, const double *b) {
  for (int k = 0; k < 3; k++) EXPECT_EQ(a[k], b[k]);
}

/** The mended routines give the same numbers to the last bit, and nothing that is found is said to be missed. */
TEST(wall_searches, are_those_of_liggghts) {
  RandomPairs random(20);
  int planes = 0, edges = 0, missed_planes = 0, missed_edges = 0;
  for (int n = 0; n < 100000; n++) {
    GrainAndTriangle it(random);
    double blockiness[2] = {2.0, 2.0};
    Superquadric grain(it.centre, it.quaternion, it.semi_axes, blockiness);
    PlainSuperquadric plain(it.centre, it.quaternion, it.semi_axes);
    double deepest[2][3], lowest[2][3], closest[2][3];
    const bool cut = plain.plane(it.normal, it.corners[0], deepest[0], lowest[0]);
    EXPECT_EQ(grain.plane_intersection(it.normal, it.corners[0], deepest[1], lowest[1]), cut);
    expect_same(deepest[0], deepest[1]);
    expect_same(lowest[0], lowest[1]);
    bool reached = false;
    for (int k = 0; k < 3; k++) {
      const double *a = it.corners[k], *b = it.corners[(k + 1) % 3];
      EXPECT_EQ(grain.shape_function_global(a), plain.value(a));
      EXPECT_EQ(grain.line_intersection(a, b, closest[0]), plain.line(a, b, closest[1]));
      expect_same(closest[0], closest[1]);
      const bool found = plain.edge(a, b);
      EXPECT_EQ(grain.edge_intersection(a, b), found);
      reached = reached || found || plain.value(a) < 0.0;
    }
    const bool misses_plane =
        grainscope::misses_plane(it.normal, it.corners[0], it.centre, grain.rotation_matrix, it.semi_axes);
    const bool misses_edges = grainscope::misses_edges(it.rows, it.centre, grain.rotation_matrix, grain.shape_inv);
    EXPECT_FALSE(misses_plane && cut);
    EXPECT_FALSE(misses_edges && reached);
    planes += !cut;
    edges += !reached;
    missed_planes += misses_plane;
    missed_edges += misses_edges;
  }
  EXPECT_GT(planes, 5000);
  EXPECT_GT(edges, 5000);
  EXPECT_GT(missed_planes, 0.5 * planes);
  EXPECT_GT(missed_edges, 0.5 * edges);
}

}

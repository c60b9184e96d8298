// SPDX-License-Identifier: GPL-2.0-or-later
#include "field_gradient.h"
#include "field_map.h"
#include "field_sums.h"
#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace grainscope { namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Kind = FieldKernel::Kind;

Matrix3d tilted_edges() {
  Matrix3d edges;
  edges << 6.0, 2.0, -1.0, 0.0, 5.0, 1.5, 0.0, 0.0, 4.0;
  return edges;
}

using Axes = std::array<bool, 3>;
const Axes all{{true, true, true}}, none{{false, false, false}};

FieldMap::Space tilted_space() { return {Vector3d(-1.0, 2.0, 0.5), tilted_edges(), {{true, true, true}}}; }

FieldMap whole_box(const FieldCells::Numbers &numbers, Kind kind = Kind::cell, double width = 1.0) {
  const FieldMap::Space space = tilted_space();
  return FieldMap(FieldCells::blocks(space.corner, space.edges, numbers, {{true, true, true}}), space, true, all, kind,
                  width);
}

class Random {
 public:
  Vector3d point(double low, double high) {
    std::uniform_real_distribution<double> uniform(low, high);
    return {uniform(engine_), uniform(engine_), uniform(engine_)};
  }

 private:
  std::mt19937 engine_{4};
};

/** Shares of a line by many points on it: each counts for the cell that holds it. */
std::map<int, double> sampled(const FieldMap &map, const Vector3d &a, const Vector3d &b, int points) {
  std::map<int, double> shares;
  for (int k = 0; k < points; k++)
    map.for_each_at(a + (k + 0.5) / points * (b - a),
                    [&](int cell, double weight, const Vector3d &) { shares[cell] += weight / points; });
  return shares;
}

std::map<int, double> cut(const FieldMap &map, const Vector3d &a, const Vector3d &b) {
  std::map<int, double> shares;
  map.for_each_along(a, b, [&](int cell, double share, const Vector3d &) { shares[cell] += share; });
  return shares;
}

void expect_same(const std::map<int, double> &found, const std::map<int, double> &expected, double tolerance) {
  for (const auto &one : expected) {
    const auto at = found.find(one.first);
    EXPECT_NEAR(at == found.end() ? 0.0 : at->second, one.second, tolerance) << "cell " << one.first;
  }
  for (const auto &one : found)
    if (!expected.count(one.first)) {
      EXPECT_LT(one.second, tolerance) << "cell " << one.first;
    }
}

double sum_of(const std::map<int, double> &shares) {
  double sum = 0.0;
  for (const auto &one : shares) sum += one.second;
  return sum;
}

TEST(FieldMap, PartsOfLinesInATiltedPeriodicBox) {
  Random random;
  for (const FieldCells::Numbers &numbers : {FieldCells::Numbers{{4, 3, 2}}, {{1, 9, 1}}, {{1, 1, 1}}, {{20, 1, 3}}}) {
    const FieldMap map = whole_box(numbers);
    for (int k = 0; k < 40; k++) {
      const Vector3d a = random.point(-8.0, 8.0), b = a + random.point(-2.5, 2.5);
      const std::map<int, double> parts = cut(map, a, b);
      EXPECT_NEAR(sum_of(parts), 1.0, 1e-13);
      expect_same(parts, sampled(map, a, b, 2000), 0.003);  // a cell errs by 2 or, by periodic faces, some points
    }
  }
}

TEST(FieldMap, LinesAlongThePlanesBetweenCells) {
  const FieldMap::Space space = {Vector3d::Zero(), 4.0 * Matrix3d::Identity(), {{true, true, true}}};
  const FieldMap map(FieldCells::blocks(space.corner, space.edges, {{4, 4, 4}}, {{true, true, true}}), space, true, all,
                     Kind::cell, 0.0);
  for (const Vector3d &a : {Vector3d(0, 0, 0), Vector3d(4, 4, 4), Vector3d(1, 2, 3), Vector3d(-1, 0, 5)})
    for (const Vector3d &d : {Vector3d(1, 0, 0), Vector3d(2, 0, 0), Vector3d(0, -3, 0), Vector3d(1, 1, 1)})
      EXPECT_NEAR(sum_of(cut(map, a, a + d)), 1.0, 1e-14);
}

TEST(FieldMap, PointsOnFacesAreInOneCell) {
  const FieldMap map = whole_box({{3, 3, 3}});
  for (double s : {0.0, 1.0, 1.0 / 3.0, -1e-17, 1.0 - 1e-16, 2.0}) {
    int found = 0;
    map.for_each_at(tilted_space().corner + tilted_edges() * Vector3d(s, 0.5, s),
                    [&](int, double, const Vector3d &) { found++; });
    EXPECT_EQ(found, 1) << s;
  }
}

TEST(FieldMap, AGridInSpaceOfOnePeriodHasEachPointOnce) {
  Random random;
  for (double length : {5.94, 1.9 * 3.3, 7.0, 11.1}) {
    Matrix3d edges = tilted_edges();
    edges(0, 0) = length;
    for (double corner : {0.0, -0.3, 1.1}) {
      const FieldMap::Space space = {Vector3d(corner, 2.0, 0.5), edges, all};
      for (int cells : {1, 3, 6, 12, 35}) {
        const FieldMap map(FieldCells::blocks(space.corner, edges.diagonal().asDiagonal(), {{cells, 3, 1}}, all), space,
                           false, all, Kind::cell, 0.0);
        for (int k = -3; k <= 2 * cells + 3; k++) {  // on every plane between cells, and every face
          const Vector3d x = space.corner + Vector3d(k * length / cells, k * 5.0 / 3.0, 0.0);
          int found = 0;
          map.for_each_at(x, [&](int, double, const Vector3d &) { found++; });
          EXPECT_EQ(found, 1) << length << " " << corner << " " << cells << " " << k;
          EXPECT_NEAR(sum_of(cut(map, x, x + Vector3d(0.0, 0.0, 3.0))), 1.0, 1e-13);
          EXPECT_NEAR(sum_of(cut(map, x, x + random.point(-4.0, 4.0))), 1.0, 1e-13);
        }
      }
    }
  }
}

TEST(FieldMap, AGridInSpaceSeesImages) {
  const FieldCells cells = FieldCells::blocks(Vector3d(0.0, -4.0, 1.0), Vector3d(9.0, 12.0, 2.0).asDiagonal(),
                                              {{3, 4, 1}}, {{false, false, false}});
  const FieldMap map(cells, tilted_space(), false, none, Kind::cell, 0.0);
  Random random;
  for (int k = 0; k < 60; k++) {
    const Vector3d x = random.point(-3.0, 6.0);
    std::map<int, double> expected, found;
    Vector3d n;
    for (n[0] = -6; n[0] <= 6; n[0]++)
      for (n[1] = -6; n[1] <= 6; n[1]++)
        for (n[2] = -6; n[2] <= 6; n[2]++)
          if (const int cell = cells.cell_of(x + tilted_edges() * n); cell >= 0) expected[cell] += 1.0;
    map.for_each_at(x, [&](int cell, double weight, const Vector3d &boxes) {
      EXPECT_EQ(cells.cell_of(x + tilted_edges() * boxes), cell);
      found[cell] += weight;
    });
    EXPECT_EQ(found, expected);
    const Vector3d b = x + random.point(-1.5, 1.5);
    expect_same(cut(map, x, b), sampled(map, x, b, 4000), 0.003);
  }
}

TEST(FieldMap, Rings) {
  const FieldMap::Space space;
  for (int along : {0, 1, 2}) {
    const Vector3d centre(0.3, -0.2, 0.1);
    const FieldCells cells = FieldCells::rings(along, centre, {{0.5, 3.5}}, {{-2.0, 2.0}}, {{5, 1, 3}}, false);
    const FieldMap map(cells, space, false, none, Kind::cell, 0.0);
    double volume = 0.0;
    for (int cell = 0; cell < cells.count(); cell++) volume += cells.volume(cell);
    EXPECT_NEAR(volume, M_PI * (3.5 * 3.5 - 0.5 * 0.5) * 4.0, 1e-12);
    Random random;
    for (int k = 0; k < 60; k++) {
      const Vector3d a = random.point(-3.0, 3.0), b = a + random.point(-3.0, 3.0);
      expect_same(cut(map, a, b), sampled(map, a, b, 4000), 0.002);
    }
    const Matrix3d frame = cells.frame(centre + Vector3d::Unit((along + 1) % 3));
    EXPECT_NEAR((frame - (Matrix3d() << Vector3d::Unit((along + 1) % 3).transpose(),
                          Vector3d::Unit((along + 2) % 3).transpose(), Vector3d::Unit(along).transpose())
                             .finished())
                    .norm(),
                0.0, 1e-15);
  }
}

TEST(FieldKernel, ItsIntegralIsOne) {
  for (Kind kind : {Kind::lucy, Kind::gaussian})
    for (int dimensions : {1, 2, 3}) {
      const FieldKernel kernel(kind, 0.7, dimensions);
      const int points = 20000;
      double sum = 0.0;
      for (int k = 0; k < points; k++) {  // the middle rule: an error of the order of 1/points^2
        const double r = (k + 0.5) * kernel.range() / points;
        const double shell = dimensions == 1 ? 2.0 : dimensions == 2 ? 2.0 * M_PI * r : 4.0 * M_PI * r * r;
        sum += kernel.at(r * r) * shell * kernel.range() / points;
      }
      EXPECT_NEAR(sum, 1.0, 1e-7);
      EXPECT_EQ(kernel.at(kernel.range() * kernel.range()), 0.0);
    }
}

TEST(FieldKernel, AlongLinesInClosedForm) {
  Random random;
  for (Kind kind : {Kind::lucy, Kind::gaussian}) {
    const FieldKernel kernel(kind, 0.6, 3);
    for (int k = 0; k < 200; k++) {
      const Vector3d p = random.point(-1.5, 1.5);
      Vector3d d = random.point(-2.0, 2.0);
      if (k == 0) d.setZero();
      if (k == 1) d = 2.0 * p;  // through the middle
      const int points = 20000;
      double sum = 0.0;
      for (int n = 0; n < points; n++) sum += kernel.at((p + (0.1 + 0.7 * (n + 0.5) / points) * d).squaredNorm());
      // Of a kernel that ends with a step, a line errs by one point's share of it.
      EXPECT_NEAR(kernel.along(p, d, 0.1, 0.8), 0.7 * sum / points, 1e-4 * kernel.at(0.0)) << k;
    }
  }
}

TEST(FieldKernel, AlongLinesThatAreAlmostPoints) {
  Random random;
  for (Kind kind : {Kind::lucy, Kind::gaussian}) {
    const FieldKernel kernel(kind, 0.6, 1);
    for (double size : {1e-2, 2e-3, 1e-3, 1e-5, 1e-8, 1e-11, 1e-13}) {
      const Vector3d p(0.3, 0.0, 0.0), d(size, 0.0, 0.0);
      const double middle = kernel.at((p + 0.5 * d).squaredNorm());
      EXPECT_NEAR(kernel.along(p, d, 0.0, 1.0), middle, kernel.at(0.0) * (1e-12 + size * size)) << size;
    }
  }
}

TEST(FieldMap, SmoothWeightsOfAPeriodicBoxAddUp) {
  Random random;
  for (Kind kind : {Kind::lucy, Kind::gaussian})
    for (const FieldCells::Numbers &numbers : {FieldCells::Numbers{{1, 60, 1}}, {{40, 1, 40}}, {{24, 20, 16}}}) {
      const FieldMap map = whole_box(numbers, kind, 0.55);
      for (int k = 0; k < 5; k++) {
        const Vector3d a = random.point(-8.0, 8.0), b = a + random.point(-1.5, 1.5);
        // Lucy's sums converge fast; a gaussian has a step of 1 % of its height at its end.
        EXPECT_NEAR(sum_of(sampled(map, a, b, 1)), 1.0, kind == Kind::lucy ? 2e-3 : 2e-2);
        const std::map<int, double> along = cut(map, a, b);
        EXPECT_NEAR(sum_of(along), 1.0, kind == Kind::lucy ? 2e-3 : 2e-2);
        expect_same(along, sampled(map, a, b, 400), 1e-3);
      }
    }
}

TEST(FieldMotion, AnAffineFlowHasNone) {
  Random random;
  Matrix3d gradient;
  gradient << 0.1, 2.0, -0.4, 0.3, -0.5, 0.7, 0.2, -0.9, 0.4;
  const FieldMap::Space space = {Vector3d::Zero(), tilted_edges(), {{false, false, false}}};
  const FieldMap map(FieldCells::blocks(space.corner, space.edges, {{3, 4, 2}}, {{false, false, false}}), space, true,
                     none, Kind::cell, 0.0);
  FieldSums sums(FieldSums::mass | FieldSums::momentum | FieldSums::centroid, map.cells().count());
  std::vector<Vector3d> points;
  for (int k = 0; k < 300; k++) points.push_back(tilted_edges() * random.point(0.0, 1.0));
  const auto flow = [&](const Vector3d &x) { return Vector3d(Vector3d(1.0, 2.0, 3.0) + gradient * x); };
  for (const Vector3d &x : points)
    map.for_each_at(x, [&](int cell, double weight, const Vector3d &) {
      *sums.of(FieldSums::mass, cell) += weight;
      Eigen::Map<Vector3d>(sums.of(FieldSums::momentum, cell)) += weight * flow(x);
      Eigen::Map<Vector3d>(sums.of(FieldSums::centroid, cell)) += weight * (x - map.cells().middle(cell));
    });
  const FieldMotion motion(map, sums, {{false, false, false}}, Matrix3d::Zero());
  for (const Vector3d &x : points)
    map.for_each_at(x, [&](int cell, double, const Vector3d &) {
      EXPECT_NEAR((motion.velocity(cell, x) - flow(x)).norm(), 0.0, 1e-11);
    });
}

}}

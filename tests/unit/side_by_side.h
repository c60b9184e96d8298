// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SIDE_BY_SIDE_H
#define GRAINSCOPE_SIDE_BY_SIDE_H

#include "concentric.h"
#include "ellipsoid_contact.h"
#include "off_place.h"
#include "pair_group.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

/** Many pairs of spheroids, packed in groups for meet_spheroids(). */
class SideBySide {
 public:
  struct Query {
    grainscope::Spheroid one, two;
    double d[3], start;
  };

  explicit SideBySide(std::vector<Query> queries) : queries_(std::move(queries)), history_(queries_.size()) {
    const int n = static_cast<int>(queries_.size());
    for (Query &q : queries_) {
      const double nowhere[3] = {0.0, 0.0, 0.0};
      pack(q.one, nowhere);
      pack(q.two, q.d);
      double &remembered = history_[grains_.size() / 2 - 1];
      remembered = q.start == 0.0 ? 0.0 : q.start - 0.5;
      q.start = remembered == 0.0 ? 0.0 : remembered + 0.5;
    }
    for (int first = 0; first < n; first += grainscope::LANES) {
      grainscope::PairGroup group;
      group.size = std::min(n - first, grainscope::LANES);
      for (int k = 0; k < grainscope::LANES; k++) {
        const int number = first + std::min(k, group.size - 1);
        group.i[k] = 2 * number;
        group.j[k] = 2 * number + 1;
        group.history[k] = &history_[number];
      }
      groups_.push_back(group);
    }
  }
  SideBySide(const SideBySide &) = delete;  // groups point into it

  /** Their starts are those that a history can tell. */
  const std::vector<Query> &queries() const { return queries_; }

  /** use(group, geometry) of each. */
  template <class Use>
  void meet(Use use) {
    const grainscope::PackedGrains grains = {grains_.data(), shapes_.data(), false, nullptr, 0};
    OffPlace<grainscope::GroupGeometry> geometry;
    for (const grainscope::PairGroup &group : groups_) {
      meet_spheroids(grains, group, geometry.here, tally_.here);
      use(group, geometry.here);
    }
  }

  /** Those that no lane answers are asked of ellipsoid_contact(). */
  std::vector<grainscope::EllipsoidContact> contacts() {
    std::vector<grainscope::EllipsoidContact> found;
    meet([&](const grainscope::PairGroup &group, const grainscope::GroupGeometry &g) {
      for (int k = 0; k < group.size; k++) {
        const Query &q = queries_[found.size()];
        const bool spheres = is_sphere(q.one) && is_sphere(q.two);
        if (g.alone[k] || !g.reachable[k] || spheres) found.push_back(ellipsoid_contact(q.one, q.two, q.d, q.start));
        else found.push_back(in_lane(g, k));
      }
    });
    return found;
  }

 private:
  std::vector<Query> queries_;
  std::vector<double> history_;
  std::vector<grainscope::PackedGrain> grains_;
  std::vector<grainscope::PackedShape> shapes_;
  std::vector<grainscope::PairGroup> groups_;
  OffPlace<grainscope::SolverTally> tally_;

  static bool is_sphere(const grainscope::Spheroid &body) { return grainscope::contact_solver::is_sphere(body); }

  /** Within reach of everything. */
  void pack(const grainscope::Spheroid &body, const double *x) {
    grainscope::PackedGrain grain{};
    std::copy_n(x, 3, grain.x);
    std::copy_n(body.u, 3, grain.axis);
    grain.reach = HUGE_VAL;
    grain.inverse_product = body.inverse_product;
    grains_.push_back(grain);
    shapes_.push_back(
        {body.equatorial_square, body.polar_square, body.inverse_equatorial_square, body.inverse_polar_square});
  }

  static grainscope::EllipsoidContact in_lane(const grainscope::GroupGeometry &g, int k) {
    grainscope::EllipsoidContact c{};
    c.touching = g.touching[k];
    c.steps = static_cast<int>(g.steps[k]);
    c.lambda = g.lambda[k];
    if (!c.touching) c.gap = g.gap[k];
    if (!c.touching) return c;
    for (int i = 0; i < 3; i++) {
      c.normal[i] = g.normal[i][k];
      c.point[i] = g.point[i][k];
    }
    for (int i = 0; i < 2; i++) {
      c.depth[i] = g.depth[i][k];
      c.curvature[i] = g.curvature[i][k];
    }
    return c;
  }
};

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PACKED_PAIRS_H
#define GRAINSCOPE_PACKED_PAIRS_H

#include "ellipsoid_pairs.h"
#include "pair_group.h"
#include <algorithm>
#include <vector>

namespace packed_pairs {

using namespace grainscope;

enum class Grains { spheres, round, spheroids };  // for push_spheres(), push_round(), push_ellipsoids()

/** Grains at random in a box, most of them through each other, and groups of pairs of them. */
struct Scene {
  RandomPairs random;
  std::vector<PackedGrain> grains;
  std::vector<PackedShape> shapes;
  std::vector<Spheroid> bodies;
  std::vector<int> types;
  std::vector<bool> frozen;
  std::vector<PackedForce> forces;
  int own;

  Scene(unsigned long seed, Grains kind, int count, int own_grains, double edge, double largest_ratio = 3.0)
      : random(seed), forces(own_grains + 1), own(own_grains) {
    for (int i = 0; i < count; i++) add(kind, edge, largest_ratio);
    for (PackedForce &force : forces)
      for (int k = 0; k < 3; k++) {
        force.force[k] = random.normal();
        force.torque[k] = random.normal();
      }
  }

  PackedGrains packed() { return {grains.data(), shapes.data(), shapes.size() == 1, forces.data(), own}; }

  int any(int from, int to) { return from + static_cast<int>(random.uniform() * (to - from)); }

  /** Pairs of an own grain and another. */
  PairGroup group(int size, std::vector<double> &history) {
    PairGroup g;
    g.size = size;
    for (int k = 0; k < LANES; k++) {
      if (k < size) {
        g.i[k] = any(0, own);
        do g.j[k] = any(0, static_cast<int>(grains.size()));
        while (g.j[k] == g.i[k]);
      } else {
        g.i[k] = g.i[size - 1];
        g.j[k] = g.j[size - 1];
      }
      g.history[k] = &history[4 * std::min(k, size - 1)];
    }
    return g;
  }

  void place(const PairGroup &group, int k, double *d) const {
    for (int l = 0; l < 3; l++) d[l] = grains[group.j[k]].x[l] - grains[group.i[k]].x[l];
  }

 private:
  void add(Grains kind, double edge, double largest_ratio) {
    GrainPair shape;
    const bool sphere = kind != Grains::spheroids;
    const double ratio = sphere ? 1.0 : random.logarithmic(1.0 / largest_ratio, largest_ratio);
    random.spheroid(shape, 0, ratio, random.uniform(0.8, 1.2));
    const Spheroid body = make_spheroid(shape.semi[0], shape.quaternion[0]);
    PackedGrain grain{};
    for (int k = 0; k < 3; k++) {
      grain.x[k] = random.uniform(0.0, edge);
      grain.velocity[k] = random.normal();
      grain.spin[k] = random.normal();
      grain.axis[k] = body.u[k];
    }
    grain.reach = *std::max_element(shape.semi[0], shape.semi[0] + 3);
    grain.mass = random.uniform(1.0, 3.0);
    grain.size = sphere ? grain.reach : grain.reach * 0.9;
    grain.inverse_product = body.inverse_product;
    if (kind == Grains::round) {
      grain.axis[0] = std::sqrt(body.equatorial_square);
      grain.reach *= 1.05;  // bounding spheres may be larger
    }
    grains.push_back(grain);
    shapes.push_back(
        {body.equatorial_square, body.polar_square, body.inverse_equatorial_square, body.inverse_polar_square});
    bodies.push_back(body);
    types.push_back(any(0, 3));
    frozen.push_back(random.uniform() < 0.3);
  }
};

}

#endif

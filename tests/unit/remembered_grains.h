// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_REMEMBERED_GRAINS_H
#define GRAINSCOPE_REMEMBERED_GRAINS_H

#include "ellipsoid_contact.h"
#include "separation_memory.h"
#include "symmetry_axis.h"
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace remembered_grains {

using namespace grainscope;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/** Ellipsoids in a box, and the memory of all pairs of them within reach of each other. */
struct Grains {
  Matrix3d edges = Matrix3d::Identity();
  Vector3d origin = Vector3d::Zero();
  std::vector<Vector3d> x;
  std::vector<Quaterniond> q;
  std::vector<std::array<double, 3>> shape;
  struct Pair {
    int i, j;
  };
  std::vector<Pair> pairs;
  std::vector<PackedGrain> packed;
  SeparationMemory memory;
  double reach = 0.0;

  void list(double within) {
    reach = within;
    pairs.clear();
    for (int i = 0; i < int(x.size()); i++)
      for (int j = i + 1; j < int(x.size()); j++)
        if ((x[i] - x[j]).norm() <= reach) pairs.push_back({i, j});
    const bool alike = std::count(shape.begin(), shape.end(), shape[0]) == int(shape.size());
    packed.assign(x.size(), PackedGrain());
    memory.restart(x.size(), pairs.size(), reach, alike, [this](int i) {
      const auto ends = std::minmax_element(shape[i].begin(), shape[i].end());
      return (*ends.second - *ends.first) * (is_triaxial(i) ? 2.0 : 1.0);
    });
    move();
  }

  bool is_triaxial(int i) const { return symmetry_axis(shape[i].data()).shape == Shape::triaxial; }

  void move() {
    memory.move(edges, origin, packed.data(), [this](int first, int many) {
      for (int i = first; i < first + many; i++) pack(i);
    });
  }

  void pack(int i) {
    const double wxyz[4] = {q[i].w(), q[i].x(), q[i].y(), q[i].z()};
    PackedGrain &grain = packed[i];
    std::copy_n(x[i].data(), 3, grain.x);
    if (is_triaxial(i)) {
      std::copy_n(wxyz, 3, grain.axis);
      grain.inverse_product = wxyz[3];
    } else {
      rotated_axis(wxyz, std::max(symmetry_axis(shape[i].data()).index, 0), grain.axis);
    }
  }

  EllipsoidContact contact(int k) const {
    Triaxial body[2];
    const int grain[2] = {pairs[k].i, pairs[k].j};
    for (int side = 0; side < 2; side++) {
      const Quaterniond &a = q[grain[side]];
      const double wxyz[4] = {a.w(), a.x(), a.y(), a.z()};
      body[side] = make_triaxial(shape[grain[side]].data(), wxyz);
    }
    const Vector3d d = x[grain[1]] - x[grain[0]];
    return ellipsoid_contact(body[0], body[1], d.data(), 0.0);
  }

  /** At least the distance of the surfaces, and hardly more: Gilbert's iteration on the differences of their points. */
  double distance(int k) const {
    const Pair &pair = pairs[k];
    Matrix3d b[2];
    for (int side = 0; side < 2; side++) {
      const int i = side ? pair.j : pair.i;
      const Matrix3d r = q[i].toRotationMatrix();
      const Vector3d s(shape[i].data());
      b[side] = r * s.cwiseAbs2().asDiagonal() * r.transpose();
    }
    Vector3d v = x[pair.j] - x[pair.i];
    for (int round = 0; round < 40; round++) {
      const Vector3d b1 = b[0] * v, b2 = b[1] * v;
      const Vector3d nearest = x[pair.j] - x[pair.i] - b1 / std::sqrt(v.dot(b1)) - b2 / std::sqrt(v.dot(b2)),
                     along = nearest - v;
      v += std::min(1.0, std::max(0.0, -v.dot(along) / along.squaredNorm())) * along;
    }
    return v.norm();
  }

  double motion(int k) const { return memory.moved(pairs[k].i) + memory.moved(pairs[k].j); }
  bool may_touch(int k) const { return memory.may_touch(k, motion(k)); }

  /** As the pair loop does: looks where it must, remembers what it found. */
  void look(int k) {
    const EllipsoidContact c = contact(k);
    if (c.touching) memory.set_touching(k);
    else memory.set_apart(k, c.gap, motion(k));
  }
};

}

#endif

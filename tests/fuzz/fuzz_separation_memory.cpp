// SPDX-License-Identifier: GPL-2.0-or-later
#include "input.h"
#include "remembered_grains.h"

using namespace remembered_grains;

namespace {

Vector3d vector(fuzz::Input &input, double size) {
  return size * Vector3d(input.small(), input.small(), input.small());
}

Quaterniond turn(fuzz::Input &input) {
  double q[4];
  input.direction(q, 4);
  return Quaterniond(q[0], q[1], q[2], q[3]);
}

}

/** Grains in a box that move, turn and are sheared in any way: one that touches another is never taken for apart. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzz::Input input(data, size);
  Grains g;
  g.origin = vector(input, 5.0);
  g.edges = (Vector3d(8.0, 9.0, 10.0) + vector(input, 4.0)).asDiagonal();
  g.edges(0, 1) = 5.0 * input.small();
  const int n = input.whole(2, 5);
  for (int i = 0; i < n; i++) {
    g.x.push_back(g.origin + vector(input, 4.0));
    g.q.push_back(turn(input));
    const double a = input.uniform(0.3, 1.5), b = input.flag() ? a : input.uniform(0.3, 1.5);
    g.shape.push_back({a, b, input.logarithmic(0.1, 5.0)});
  }
  g.list(12.0);
  for (int step = 0; step < 10 && !input.empty(); step++) {
    for (std::size_t k = 0; k < g.pairs.size(); k++) {
      if ((g.x[g.pairs[k].i] - g.x[g.pairs[k].j]).norm() > 1.5 * g.reach) return 0;
      const bool looks = g.may_touch(k);
      fuzz::require(looks || !g.contact(k).touching, "what touches is looked at", g.contact(k).depth[0]);
      if (looks) g.look(k);
    }
    Matrix3d f = Matrix3d::Identity();
    if (input.flag())
      for (int k = 0; k < 3; k++) f.row(k) += vector(input, 0.1).transpose();
    for (int i = 0; i < n; i++) {
      g.x[i] = g.origin + f * (g.x[i] - g.origin) + vector(input, input.flag() ? 1.0 : 0.01);
      if (input.flag())
        g.q[i] = input.flag() ? turn(input)
                              : Quaterniond(1.0, 0.01 * input.small(), 0.01 * input.small(), 0.0).normalized() * g.q[i];
    }
    g.edges = f * g.edges;
    g.origin += vector(input, 0.1);
    g.move();
  }
  return 0;
}

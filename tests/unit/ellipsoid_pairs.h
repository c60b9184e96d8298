// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ELLIPSOID_PAIRS_H
#define GRAINSCOPE_ELLIPSOID_PAIRS_H

#include "ellipsoid_contact.h"
#include "ellipsoid_reference.h"
#include <algorithm>
#include <random>

/** Two ellipsoids: semi-axes, quaternions (w, x, y, z), and d = x2 - x1. */
struct GrainPair {
  double semi[2][3], quaternion[2][4], d[3];

  reference::Body body(int k) const { return {semi[k], quaternion[k]}; }
  double largest() const {
    return std::max(*std::max_element(semi[0], semi[0] + 3), *std::max_element(semi[1], semi[1] + 3));
  }
  double smallest() const {
    return std::min(*std::min_element(semi[0], semi[0] + 3), *std::min_element(semi[1], semi[1] + 3));
  }
};

inline void make(const GrainPair &pair, int k, grainscope::Spheroid &body) {
  body = grainscope::make_spheroid(pair.semi[k], pair.quaternion[k]);
}
inline void make(const GrainPair &pair, int k, grainscope::Triaxial &body) {
  body = grainscope::make_triaxial(pair.semi[k], pair.quaternion[k]);
}

template <class Body>
grainscope::EllipsoidContact kernel_contact(const GrainPair &pair, double start = 0.0, double tolerance = 0.0) {
  Body one, two;
  make(pair, 0, one);
  make(pair, 1, two);
  return tolerance > 0.0 ? ellipsoid_contact(one, two, pair.d, start, tolerance)
                         : ellipsoid_contact(one, two, pair.d, start);
}

/** Pairs at random, repeatable. */
class RandomPairs {
 public:
  explicit RandomPairs(unsigned long seed) : generator_(seed) {}

  double normal() { return normal_(generator_); }
  double uniform(double from = 0.0, double to = 1.0) { return from + (to - from) * uniform_(generator_); }
  double logarithmic(double from, double to) { return from * std::pow(to / from, uniform()); }

  void direction(double *v, int n) {
    double square = 0.0;
    for (int k = 0; k < n; k++) {
      v[k] = normal();
      square += v[k] * v[k];
    }
    for (int k = 0; k < n; k++) v[k] /= std::sqrt(square);
  }

  void spheroid(GrainPair &pair, int k, double alpha, double size = 1.0) {
    for (int i = 0; i < 3; i++) pair.semi[k][i] = size * (i == 2 ? alpha : 1.0);
    direction(pair.quaternion[k], 4);
  }

  void triaxial(GrainPair &pair, int k, double largest_ratio, double size = 1.0) {
    for (int i = 0; i < 3; i++) pair.semi[k][i] = size * logarithmic(1.0, largest_ratio);
    direction(pair.quaternion[k], 4);
  }

  /** Centres (1 - shift) of those of tangency apart, in a random direction or in the one given. */
  void place(GrainPair &pair, double shift, const double *along = nullptr) {
    if (along)
      for (int k = 0; k < 3; k++) pair.d[k] = along[k];
    else direction(pair.d, 3);
    const reference::Quad scale =
        (1 - reference::Quad(shift)) / reference::scale_of_tangency(pair.body(0), pair.body(1), pair.d);
    for (int k = 0; k < 3; k++) pair.d[k] = static_cast<double>(scale * pair.d[k]);
  }

 private:
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
};

#endif

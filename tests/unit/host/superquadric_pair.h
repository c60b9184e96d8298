// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SUPERQUADRIC_PAIR_H
#define GRAINSCOPE_SUPERQUADRIC_PAIR_H

#include "ellipsoid_pairs.h"
#include "math_extra_liggghts_superquadric.h"

/** Motion of grain 2 past grain 1, and turns of both, in one step. */
struct PairMotion {
  double shift[3], turn[2][3];

  PairMotion(RandomPairs &random, double length, double angle);
  /** The pair a step ago. */
  GrainPair before(const GrainPair &pair) const;
};

/** What LIGGGHTS's surface model superquadric keeps of a pair. */
struct SuperquadricHistory {
  unsigned inequality = 0;
  enum { FAR, CLOSE, INTERSECT } state = FAR;
  double point[3] = {0.0, 0.0, 0.0}, alpha[2] = {0.0, 0.0};
};

/** Contact of two ellipsoids by LIGGGHTS's own routines, called as its surface model superquadric does; grain 1 is at
 *  the origin. */
class SuperquadricPair {
 public:
  explicit SuperquadricPair(const GrainPair &pair, const PairMotion *motion = nullptr);
  SuperquadricPair(const SuperquadricPair &) = delete;

  bool contact(SuperquadricHistory &history);
  double gaussian_curvature(int k);  // at the surface point of grain k, after contact()

  double normal[3] = {0.0, 0.0, 0.0};  // from 1 to 2, as the kernel's
  double point[3] = {0.0, 0.0, 0.0};
  double overlap = 0.0;

 private:
  GrainPair pair_;
  double centre_[2][3], velocity_[2][3], turn_[2][3], blockiness_[2][2] = {{2.0, 2.0}, {2.0, 2.0}};
  double surface_[2][3] = {};
  Superquadric grain_[2];
  LIGGGHTS::ContactModels::SurfacesIntersectData data_;
};

#endif

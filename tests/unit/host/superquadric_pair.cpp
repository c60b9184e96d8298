// SPDX-License-Identifier: GPL-2.0-or-later
#include "superquadric_pair.h"
#include "error.h"
#include <cstdlib>

using namespace MathExtraLiggghtsNonspherical;

// The routines' only tie to the rest of LIGGGHTS, for curvatures that are not asked here.
void LAMMPS_NS::Error::one(const char *, int, const char *) { std::abort(); }

PairMotion::PairMotion(RandomPairs &random, double length, double angle) {
  random.direction(shift, 3);
  for (auto &t : turn) random.direction(t, 3);
  for (int k = 0; k < 3; k++) {
    shift[k] *= length;
    for (auto &t : turn) t[k] *= angle;
  }
}

GrainPair PairMotion::before(const GrainPair &pair) const {
  GrainPair was = pair;
  for (int k = 0; k < 3; k++) was.d[k] -= shift[k];
  for (int i = 0; i < 2; i++) {
    // small: (1, x, y, z)
    const double *p = pair.quaternion[i], x = -0.5 * turn[i][0], y = -0.5 * turn[i][1], z = -0.5 * turn[i][2];
    double *q = was.quaternion[i];
    q[0] = p[0] - x * p[1] - y * p[2] - z * p[3];
    q[1] = p[1] + x * p[0] + y * p[3] - z * p[2];
    q[2] = p[2] + y * p[0] + z * p[1] - x * p[3];
    q[3] = p[3] + z * p[0] + x * p[2] - y * p[1];
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int k = 0; k < 4; k++) q[k] /= length;
  }
  return was;
}

SuperquadricPair::SuperquadricPair(const GrainPair &pair, const PairMotion *motion) : pair_(pair) {
  data_.mi = data_.mj = 1.0;
  data_.v_i = velocity_[0];
  data_.v_j = velocity_[1];
  data_.omega_i = turn_[0];
  data_.omega_j = turn_[1];
  for (int k = 0; k < 3; k++) {
    centre_[0][k] = 0.0;
    centre_[1][k] = pair.d[k];
    for (int i = 0; i < 2; i++) {  // in a step of length 1
      velocity_[i][k] = motion && i == 1 ? motion->shift[k] : 0.0;
      turn_[i][k] = motion ? motion->turn[i][k] : 0.0;
    }
  }
}

bool SuperquadricPair::contact(SuperquadricHistory &history) {
  for (int k = 0; k < 2; k++) grain_[k].set(centre_[k], pair_.quaternion[k], pair_.semi[k], blockiness_[k]);
  if (history.state != SuperquadricHistory::INTERSECT && !obb_intersect(&grain_[0], &grain_[1], history.inequality)) {
    history.state = SuperquadricHistory::FAR;
    return false;
  }
  const double r1 = cbrt(pair_.semi[0][0] * pair_.semi[0][1] * pair_.semi[0][2]);
  const double r2 = cbrt(pair_.semi[1][0] * pair_.semi[1][1] * pair_.semi[1][2]);
  double f1, f2;
  if (history.state == SuperquadricHistory::FAR)
    calc_contact_point_if_no_previous_point_avaialable(data_, &grain_[0], &grain_[1], point, f1, f2, nullptr);
  else
    calc_contact_point_using_prev_step(data_, &grain_[0], &grain_[1], r1 / (r1 + r2), 1.0, history.point, point, f1, f2,
                                       nullptr);
  for (int k = 0; k < 3; k++) history.point[k] = point[k];
  if (std::max(f1, f2) >= 0.0) {
    history.state = SuperquadricHistory::CLOSE;
    return false;
  }
  for (int k = 0; k < 3; k++) data_.en[k] = grain_[1].gradient[k] - grain_[0].gradient[k];
  LAMMPS_NS::vectorNormalize3D(data_.en);
  overlap = extended_overlap_algorithm(&grain_[0], &grain_[1], data_.en, &history.alpha[0], &history.alpha[1], point,
                                       surface_[0], surface_[1], data_.delta);
  for (int k = 0; k < 3; k++) normal[k] = -data_.en[k];
  history.state = SuperquadricHistory::INTERSECT;
  return true;
}

double SuperquadricPair::gaussian_curvature(int k) {
  const double root = grain_[k].calc_curvature_coefficient(1, surface_[k]);
  return root * root;
}

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_TIME_STEP_BOUND_H
#define GRAINSCOPE_TIME_STEP_BOUND_H

#include "contact_law.h"
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace grainscope {

/** Springs K and dashpots C between grains that are integrated by velocity Verlet (kick, drift, kick), with forces that
 *  use the velocity of half a step before, keep their energy bounded if the largest eigenvalue of M^-1 (dt^2 K + 2 dt
 *  C) is below 4. Two estimates of it; see doc/stability.md. */
namespace time_step {

constexpr double limit = 4.0;
/** Below this share the contact network cannot reach `limit` (smallest over all packings of doc/stability_data.md:
 *  0.47). */
constexpr double harmless = 0.4;

/** (dt^2 k + 2 dt gamma_n)/m_eff of one contact [-], k the tangent stiffness. */
inline double of_contact(const Contact &c, double effective_mass, double dt) {
  const ContactMotion &m = *c.motion;
  return dt * (dt * c.law->tangent_stiffness(m) + 2.0 * m.damping_coefficient) / effective_mass;
}

/** One grain against its contacts, held still beyond them. A contact between grains has twice its weight: |u_i - u_j|^2
 *  is at most 2 |u_i|^2 + 2 |u_j|^2. One with a wall, which does not give way, has it once. So the largest eigenvalue
 *  of all grains is never below the network's; of a grain that touches walls only it is exact. */
class GrainModes {
 public:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  /** `arm`: from the grain's centre to the contact point. */
  void add(const Contact &c, const Eigen::Vector3d &arm) {
    const ContactLaw &law = *c.law;
    const Eigen::Matrix3d n = c.normal * c.normal.transpose(), t = Eigen::Matrix3d::Identity() - n;
    const ContactMotion &m = *c.motion;
    const double k_t = law.sticks() ? m.tangential_stiffness : 0.0, damping_t = m.damped ? m.tangential_damping : 0.0;
    const double weight = c.with_wall() ? 1.0 : 2.0;
    stiffness_ += weight * seen_from(arm, law.tangent_stiffness(m) * n + k_t * t);
    damping_ += weight * seen_from(arm, m.damping_coefficient * n + damping_t * t);
  }

  /** Removes the motions that a grain in two dimensions does not have: along z, and rotations about x and y. */
  void confine_to_plane() {
    for (Matrix6 *m : {&stiffness_, &damping_})
      for (int k : {2, 3, 4}) {
        m->row(k).setZero();
        m->col(k).setZero();
      }
  }

  struct Mode {
    double value = 0.0;                     // eigenvalue of M^-1 (dt^2 K + 2 dt C) [-]
    double stiffness = 0.0, damping = 0.0;  // value = dt^2 stiffness + dt damping

    /** The time step at which it is at the limit. */
    double largest_step() const {
      return 2.0 * limit / (std::sqrt(damping * damping + 4.0 * limit * stiffness) + damping);
    }
  };

  /** `inertia`: tensor in the laboratory frame. */
  Mode fastest(double mass, const Eigen::Matrix3d &inertia, double dt) const {
    Matrix6 m = Matrix6::Zero();
    m.topLeftCorner<3, 3>() = mass * Eigen::Matrix3d::Identity();
    m.bottomRightCorner<3, 3>() = inertia;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6> modes(dt * dt * stiffness_ + 2.0 * dt * damping_, m);
    const Eigen::Matrix<double, 6, 1> v = modes.eigenvectors().col(5);  // v.M v = 1
    return {modes.eigenvalues()[5], v.dot(stiffness_ * v), 2.0 * v.dot(damping_ * v)};
  }

 private:
  Matrix6 stiffness_ = Matrix6::Zero(), damping_ = Matrix6::Zero();

  /** B^T K B with B = (1, -[arm]x), which takes velocity and spin to the contact point. */
  static Matrix6 seen_from(const Eigen::Vector3d &arm, const Eigen::Matrix3d &k) {
    Eigen::Matrix<double, 3, 6> b;
    b << 1.0, 0.0, 0.0, 0.0, arm[2], -arm[1], 0.0, 1.0, 0.0, -arm[2], 0.0, arm[0], 0.0, 0.0, 1.0, arm[1], -arm[0], 0.0;
    return b.transpose() * k * b;
  }
};

}

}

#endif

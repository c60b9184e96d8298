// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_MAKE_CONTACT_H
#define GRAINSCOPE_MAKE_CONTACT_H

#include "contact.h"

/** Grain 0 touches grain 1 along x, two apart: a normal force of 10, of which 4 is damping, and friction of 3 along y. */
inline grainscope::Contact make_contact(double weight = 1.0) {
  grainscope::Contact c{};
  c.i = 0;
  c.j = 1;
  c.ghost = weight < 1.0;
  c.weight = weight;
  c.branch = Eigen::Vector3d(2.0, 0.0, 0.0);
  c.point = Eigen::Vector3d(-1.0, 0.0, 0.0);
  c.normal = Eigen::Vector3d(1.0, 0.0, 0.0);
  c.overlap = 0.01;
  c.normal_force = 10.0;
  c.normal_damping = 4.0;
  c.normal_velocity = -0.5;
  c.tangential_force = Eigen::Vector3d(0.0, 3.0, 0.0);
  c.force = Eigen::Vector3d(10.0, 3.0, 0.0);
  c.tangential_velocity = Eigen::Vector3d(0.0, -2.0, 0.0);
  c.friction = 0.3;
  c.friction_limit = 3.0;
  c.friction_force = c.tangential_force;
  c.sliding = true;
  c.slip = 0.002;
  c.normal_stiffness = 600.0;
  c.tangential_stiffness = 500.0;
  c.damping_coefficient = 8.0;
  c.tangential_damping = 5.0;
  return c;
}

#endif

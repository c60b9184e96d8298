// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SPHEROID_MOTION_H
#define GRAINSCOPE_SPHEROID_MOTION_H

namespace grainscope {

/** Symmetric tops (spheroid_rotation.h) in arrays of rows: of three numbers, of quaternions four. */
struct Spheroids {
  int n, group;  // those move whose mask has a bit of the group's
  const int *mask;
  const double *mass, *inertia, *force, *torque;
  double *x, *v, *momentum, *quaternion, *omega;
};

/** v += kick f/m, L += kick t, and omega that follows. */
void kick(const Spheroids &grains, double kick);

/** Likewise, and then a free flight by dt: x += dt v, and the rotation. */
void kick_and_drift(const Spheroids &grains, double kick, double dt);

}

#endif

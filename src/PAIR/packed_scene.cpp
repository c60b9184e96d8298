// SPDX-License-Identifier: GPL-2.0-or-later
#include "packed_scene.h"
#include <cmath>

namespace grainscope {

void PackedScene::restart(const EllipsoidBodies &bodies) {
  const int n = atom->nlocal + atom->nghost;
  grains_.assign(n, PackedGrain());
  shapes_.resize(n);
  for (int i = 0; i < n; i++) {
    const Spheroid &s = bodies.spheroid(i);
    PackedGrain &grain = grains_[i];
    grain.size = bodies.equivalent_radius(i);
    grain.inverse_product = s.inverse_product;
    if (bodies.only_spheres()) grain.axis[0] = std::sqrt(s.equatorial_square);
    shapes_[i] = {s.equatorial_square, s.polar_square, s.inverse_equatorial_square, s.inverse_polar_square};
  }
}

void PackedScene::load(const EllipsoidBodies &bodies) {
  const int own = atom->nlocal, n = static_cast<int>(grains_.size());
  const bool turning = !bodies.only_spheres();
  for (int i = 0; i < n; i++) {
    PackedGrain &grain = grains_[i];
    std::copy(atom->x[i], atom->x[i] + 3, grain.x);
    std::copy(atom->v[i], atom->v[i] + 3, grain.velocity);
    std::copy(atom->omega[i], atom->omega[i] + 3, grain.spin);
    grain.reach = atom->radius[i];
    grain.mass = atom->rmass[i];
    if (turning) std::copy(bodies.spheroid(i).u, bodies.spheroid(i).u + 3, grain.axis);
  }
  forces_.resize(own + 1);
  for (int i = 0; i < own; i++) {
    std::copy(atom->f[i], atom->f[i] + 3, forces_[i].force);
    std::copy(atom->torque[i], atom->torque[i] + 3, forces_[i].torque);
  }
  forces_[own] = PackedForce{};
}

void PackedScene::hand_back_forces() const {
  const int own = static_cast<int>(forces_.size()) - 1;
  for (int i = 0; i < own; i++) {
    std::copy(forces_[i].force, forces_[i].force + 3, atom->f[i]);
    std::copy(forces_[i].torque, forces_[i].torque + 3, atom->torque[i]);
  }
}

}

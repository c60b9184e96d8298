// SPDX-License-Identifier: GPL-2.0-or-later
#include "packed_scene.h"
#include <algorithm>
#include <cmath>

namespace grainscope {

void PackedScene::restart(const EllipsoidBodies &bodies) {
  const int n = atom->nlocal + atom->nghost;
  grains_.assign(n, PackedGrain());
  shapes_.resize(n);
  symmetry_.resize(n);
  bool alike = true;
  for (int i = 0; i < n; i++) {
    const Spheroid &s = bodies.spheroid(i);
    PackedGrain &grain = grains_[i];
    grain.size = bodies.equivalent_radius(i);
    grain.inverse_product = s.inverse_product;
    std::copy(s.u, s.u + 3, grain.axis);
    if (bodies.only_spheres()) grain.axis[0] = std::sqrt(s.equatorial_square);
    shapes_[i] = {s.equatorial_square, s.polar_square, s.inverse_equatorial_square, s.inverse_polar_square};
    symmetry_[i] = bodies.is_sphere(i) ? KEPT : bodies.symmetry(i);
    alike = alike && s.equatorial_square == shapes_[0].equatorial_square && s.polar_square == shapes_[0].polar_square;
  }
  if (alike && n > 0) shapes_.resize(1);
}

void PackedScene::load(const EllipsoidBodies *bodies) {
  const int own = atom->nlocal, n = own + atom->nghost;
  grains_.resize(n);
  if (n > 0) {
    const GrainRows rows{n,
                         atom->x[0],
                         atom->v[0],
                         atom->omega[0],
                         bodies ? atom->quaternion[0] : nullptr,
                         atom->radius,
                         atom->rmass,
                         bodies ? nullptr : atom->radius};
    pack_motion(rows, grains_.data());
    if (bodies && !bodies->only_spheres()) pack_axes(rows, symmetry_.data(), grains_.data());
  }
  forces_.resize(own + 1);
  for (int i = 0; i < own; i++) {
    const double *f = atom->f[i], *torque = atom->torque[i];
    for (int k = 0; k < 3; k++) {
      forces_[i].force[k] = f[k];
      forces_[i].torque[k] = torque[k];
    }
  }
  forces_[own] = PackedForce{};
}

void PackedScene::hand_back_forces() const {
  const int own = static_cast<int>(forces_.size()) - 1;
  for (int i = 0; i < own; i++) {
    double *f = atom->f[i], *torque = atom->torque[i];
    for (int k = 0; k < 3; k++) {
      f[k] = forces_[i].force[k];
      torque[k] = forces_[i].torque[k];
    }
  }
}

}

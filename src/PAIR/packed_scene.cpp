// SPDX-License-Identifier: GPL-2.0-or-later
#include "packed_scene.h"
#include "fitted.h"
#include <algorithm>
#include <cmath>

namespace grainscope {

void PackedScene::restart(const EllipsoidBodies &bodies) {
  const int n = atom->nlocal + atom->nghost;
  fit(grains_, n);
  fit(symmetry_, n);
  fit(shapes_, bodies.one_shape() ? 1 : n);
  for (int i = 0; i < n; i++) {
    const Spheroid &s = bodies.spheroid(i);
    PackedGrain &grain = grains_[i];
    grain.size = bodies.equivalent_radius(i);
    grain.inverse_product = s.inverse_product;
    std::copy(s.u, s.u + 3, grain.axis);
    if (bodies.only_spheres()) grain.axis[0] = std::sqrt(s.equatorial_square);
    symmetry_[i] = bodies.is_sphere(i) ? KEPT : bodies.is_triaxial(i) ? QUATERNION : bodies.symmetry(i);
  }
  for (std::size_t i = 0; i < shapes_.size(); i++) {
    const Spheroid &s = bodies.spheroid(i);
    shapes_[i] = {s.equatorial_square, s.polar_square, s.inverse_equatorial_square, s.inverse_polar_square};
  }
}

void PackedScene::load(const EllipsoidBodies *bodies, int first, int many) {
  if (many == 0) return;
  const GrainRows rows{many,
                       atom->x[first],
                       atom->v[first],
                       atom->omega[first],
                       bodies ? atom->quaternion[first] : nullptr,
                       atom->radius + first,
                       atom->rmass + first,
                       bodies ? nullptr : atom->radius + first};
  pack_motion(rows, &grains_[first]);
  if (bodies && !bodies->only_spheres()) pack_axes(rows, &symmetry_[first], &grains_[first]);
}

void PackedScene::load_spheres() {
  const int n = atom->nlocal + atom->nghost;
  fit(grains_, n);
  load(nullptr, 0, n);
  load_forces();
}

void PackedScene::load_forces() {
  const int own = atom->nlocal;
  fit(forces_, own + 1);
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

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SPHERE_LOOP_H
#define GRAINSCOPE_SPHERE_LOOP_H

#include "lane_loop.h"
#include "neigh_list.h"
#include <array>

namespace grainscope {

/** The pair loop of `surface default` and atom style sphere. */
template <class Model>
class SphereLoop : public LaneLoop<Model> {
  using Loop = LaneLoop<Model>;

 public:
  using Loop::Loop;

 private:
  using Loop::geometry_;
  using Loop::group_;
  using Loop::lmp_;
  using Loop::pair_;
  using Loop::scene_;
  using typename Loop::Pair;

  std::array<Pair, LANES> members_;
  int many_ = 0;

  bool serves() const override {
    const LAMMPS_NS::Atom *atom = lmp_->atom;
    return atom->sphere_flag && !atom->superquadric_flag && atom->rmass;
  }
  void evaluate() override;
  void approach(int k) override;
  void work();
};

template <class Model>
void SphereLoop<Model>::evaluate() {
  scene_.load(nullptr);
  const LAMMPS_NS::NeighList *list = pair_->list, *history = pair_->listgranhistory;
  const int columns = pair_->dnum();
  const PackedGrain *grains = scene_.grains().grains;
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii], neighbours = list->numneigh[i];
    const int *partners = list->firstneigh[i];
    int *flags = history ? history->firstneigh[i] : nullptr;
    double *rows = history ? history->firstdouble[i] : nullptr;
    const PackedGrain &grain = grains[i];
    for (int jj = 0; jj < neighbours; jj++) {
      const int j = partners[jj] & NEIGHMASK;
      const PackedGrain &other = grains[j];
      const double dx = grain.x[0] - other.x[0], dy = grain.x[1] - other.x[1], dz = grain.x[2] - other.x[2],
                   reach = grain.reach + other.reach;
      const Pair pair{i, j, 0, flags ? flags + jj : nullptr, rows ? rows + columns * jj : nullptr};
      if (dx * dx + dy * dy + dz * dz < reach * reach) {
        members_[many_++] = pair;
        if (many_ == LANES) work();
      } else if (flags && flags[jj]) {
        this->close(pair);
      }
    }
  }
  if (many_) work();
}

template <class Model>
void SphereLoop<Model>::work() {
  const int n = many_;
  many_ = 0;
  group_.size = n;
  for (int k = 0; k < LANES; k++) {
    const Pair &pair = members_[std::min(k, n - 1)];
    group_.i[k] = pair.i;
    group_.j[k] = pair.j;
    group_.history[k] = pair.history;
  }
  meet_spheres(scene_.grains(), group_, geometry_);
  if (this->in_lanes()) {
    this->set_law_of_pairs();
    push_spheres(scene_.grains(), group_, geometry_, this->group_law_, this->kept_);
    this->follow_up([this](int k) -> const Pair & { return members_[k]; }, n);
  } else {
    for (int k = 0; k < n; k++) this->enter(members_[k], k);
  }
}

template <class Model>
void SphereLoop<Model>::approach(int k) {
  typename Model::Surfaces &s = this->s_;
  s.radi = lmp_->atom->radius[group_.i[k]];
  s.radj = lmp_->atom->radius[group_.j[k]];
  for (int l = 0; l < 3; l++) s.en[l] = s.delta[l] * s.rinv;
}

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SPHERE_LOOP_H
#define GRAINSCOPE_SPHERE_LOOP_H

#include "lane_loop.h"
#include "neigh_list.h"
#include <algorithm>
#include <array>
#include <cstdint>

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

  static constexpr int MANY = 64;  // neighbours of a grain at a time
  std::array<Pair, LANES> members_;
  int many_ = 0;

  bool serves() const override {
    const LAMMPS_NS::Atom *atom = lmp_->atom;
    return atom->sphere_flag && !atom->superquadric_flag && atom->rmass;
  }
  void evaluate() override;
  void approach(int k) override;
  void fetch(int i) const;
  void visit(int i, int first, int count);
  void work();
};

template <class Model>
void SphereLoop<Model>::evaluate() {
  scene_.load(nullptr);
  const LAMMPS_NS::NeighList *list = pair_->list;
  for (int ii = 0; ii < list->inum; ii++) {
    if (ii + 1 < list->inum) fetch(list->ilist[ii + 1]);
    const int i = list->ilist[ii], neighbours = list->numneigh[i];
    for (int first = 0; first < neighbours; first += MANY) visit(i, first, std::min(MANY, neighbours - first));
  }
  if (many_) work();
}

/** The next grain's neighbours, as far as the test of their distance asks for them. */
template <class Model>
inline void SphereLoop<Model>::fetch(int i) const {
  const PackedGrain *grains = scene_.packed();
  const int *partners = pair_->list->firstneigh[i];
  for (int jj = 0; jj < pair_->list->numneigh[i]; jj++) __builtin_prefetch(grains[partners[jj] & NEIGHMASK].x);
}

/** Grain i and some of its neighbours, at most 64, from place `first` of its list on. */
template <class Model>
inline void SphereLoop<Model>::visit(int i, int first, int count) {
  const LAMMPS_NS::NeighList *history = pair_->listgranhistory;
  const int *partners = pair_->list->firstneigh[i] + first;
  const int *flags = history ? history->firstneigh[i] + first : nullptr;
  std::array<int, MANY> others;
  std::uint64_t flagged = 0;
  for (int k = 0; k < count; k++) {
    others[k] = partners[k] & NEIGHMASK;
    if (history) flagged |= std::uint64_t(flags[k] != 0) << k;
  }
  const std::uint64_t touching = within_reach(scene_.packed(), i, others.data(), count);
  const NearPairs::Lists lists{pair_->list, history, pair_->dnum()};
  const auto pair = [&](int k) { return lists.pair(i, first + k, 0); };
  for (std::uint64_t parted = flagged & ~touching; parted; parted &= parted - 1)
    this->close(pair(__builtin_ctzll(parted)));
  for (std::uint64_t left = touching; left; left &= left - 1) {
    members_[many_++] = pair(__builtin_ctzll(left));
    if (many_ == LANES) work();
  }
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

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
  std::array<int, LANES> places_;  // of the j of group_ in the list of i

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
  scene_.load_spheres();
  this->push_ = this->law_.synchronized() ? push_spheres_synchronized : push_spheres;
  group_.size = 0;
  const LAMMPS_NS::NeighList *list = pair_->list;
  // More grains than the second cache holds.
  const bool far = (lmp_->atom->nlocal + lmp_->atom->nghost) * sizeof(PackedGrain) > 512 * 1024;
  for (int ii = 0; ii < list->inum; ii++) {
    if (far && ii + 1 < list->inum) fetch(list->ilist[ii + 1]);
    const int i = list->ilist[ii], neighbours = list->numneigh[i];
    for (int first = 0; first < neighbours; first += MANY) visit(i, first, std::min(MANY, neighbours - first));
  }
  if (group_.size) work();
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
  const NearPairs::Lists lists = this->lists();
  const int *others = lists.list->firstneigh[i] + first;
  const std::uint64_t touching = within_reach(scene_.packed(), i, others, NEIGHMASK, count);
  if (lists.history) {
    const int *flags = lists.history->firstneigh[i] + first;
    std::uint64_t flagged = 0;
    for (int k = 0; k < count; k++) flagged |= std::uint64_t(flags[k] != 0) << k;
    for (std::uint64_t parted = flagged & ~touching; parted; parted &= parted - 1)
      this->close(lists.pair(i, first + __builtin_ctzll(parted), 0));
  }
  for (std::uint64_t left = touching; left; left &= left - 1) {
    const int place = first + __builtin_ctzll(left), k = group_.size++;
    places_[k] = place;
    group_.i[k] = i;
    group_.j[k] = lists.list->firstneigh[i][place] & NEIGHMASK;
    group_.history[k] = lists.history ? lists.history->firstdouble[i] + lists.columns * place : nullptr;
    if (group_.size == LANES) work();
  }
}

template <class Model>
void SphereLoop<Model>::work() {
  const int n = group_.size;
  for (int k = n; k < LANES; k++) {
    group_.i[k] = group_.i[n - 1];
    group_.j[k] = group_.j[n - 1];
    group_.history[k] = group_.history[n - 1];
  }
  const auto pair = [this](int k) -> Pair { return {group_.i[k], group_.j[k], 0, places_[k], group_.history[k]}; };
  meet_spheres(scene_.grains(), group_, geometry_);
  if (this->in_lanes()) {
    this->set_law_of_pairs();
    this->push_(scene_.grains(), group_, geometry_, this->group_law_, this->kept_);
    this->follow_up(pair, n);
  } else {
    for (int k = 0; k < n; k++) this->enter(pair(k), k);
  }
  group_.size = 0;
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

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ELLIPSOID_LOOP_H
#define GRAINSCOPE_ELLIPSOID_LOOP_H

#include "box_state.h"
#include "ellipsoid_surface.h"
#include "lane_loop.h"
#include "near_pairs.h"
#include "separation_memory.h"
#include "domain.h"
#include "neighbor.h"
#include <algorithm>
#include <array>

namespace grainscope {

/** The pair loop of `surface ellipsoid`. Pairs that are certainly apart are skipped. Contacts that the lanes cannot
 *  solve are solved one by one. */
template <class Model>
class EllipsoidLoop : public LaneLoop<Model> {
  using Loop = LaneLoop<Model>;

 public:
  EllipsoidLoop(LAMMPS_NS::LAMMPS *lmp, LAMMPS_NS::PairGran *pair, int64_t hash)
      : Loop(lmp, pair, hash), bodies_(this->style_.ellipsoid_bodies()), surface_(this->style_.ellipsoid_surface()) {}

 private:
  using Loop::forces_;
  using Loop::geometry_;
  using Loop::group_;
  using Loop::lmp_;
  using Loop::pair_;
  using Loop::scene_;
  using typename Loop::Pair;
  /** A pair that is to be looked at. */
  struct Candidate {
    const Pair *pair;
    double motion;  // of its two grains, so far
  };
  static constexpr std::size_t CHUNK = 128;               // near pairs at a time: what they ask for stays in the cache
  static constexpr std::size_t AHEAD = NearPairs::AHEAD;  // how many near pairs ahead is prefetched

  EllipsoidBodies &bodies_;
  const EllipsoidSurface &surface_;
  SeparationMemory apart_;
  NearPairs near_;
  NeighbourListWatch lists_;
  std::array<Candidate, CHUNK + 1> candidates_;
  std::size_t many_ = 0;                          // of them
  std::array<std::size_t, CHUNK + 1> strangers_;  // of them, those that did not touch when they were looked at last
  bool lanes_solve_all_ = false;                  // there are no pairs for which that is known not to be
  SolverTally tally_;

  void prepare(bool hosts) override { bodies_.set_keeps_turned(hosts); }
  void evaluate() override;
  void approach(int k) override;
  void follow_motion();
  void gather(const Pair *pairs, std::size_t count);
  template <class Candidates>
  void fill(Candidates candidate, int n);
  void part_strangers(std::size_t many);
  void work_on();
  void work(const Candidate *candidates, int n);
  void meet(const Candidate *candidates, int n);
  void meet_alone(const Pair &pair, int k);
  bool push(const Candidate *candidates, int n);
  void leave(const Candidate &candidate, int k);
};

template <class Model>
void EllipsoidLoop<Model>::evaluate() {
  follow_motion();
  lanes_solve_all_ = bodies_.only_spheres() || (!bodies_.some_spheres() && !bodies_.some_triaxial());
  bodies_.counts.listed += near_.listed();
  this->push_ = bodies_.only_spheres() ? (this->law_.synchronized() ? push_round_synchronized : push_round)
                                       : (this->law_.synchronized() ? push_ellipsoids_synchronized : push_ellipsoids);
  near_.go_through(this->lists(), CHUNK, [this](const Pair *pairs, std::size_t n) {
    gather(pairs, n);
    work_on();
  });
  bodies_.count(tally_);
  tally_ = SolverTally();
}

/** Where all grains are now, and which pairs are near. */
template <class Model>
void EllipsoidLoop<Model>::follow_motion() {
  const LAMMPS_NS::Atom *atom = lmp_->atom;
  const int n = atom->nlocal + atom->nghost;
  const bool renewed = lists_.renewed(*lmp_->neighbor, *lmp_->update);
  if (renewed) {
    near_.restart(this->lists());
    apart_.restart(n, near_.listed(), lmp_->neighbor->cutneighmax, bodies_.one_shape(),
                   [this](int i) { return bodies_.turn_slope(i); });
    scene_.restart(bodies_);
  }
  const BoxState box(lmp_);
  apart_.move(box.edges, Eigen::Map<const Eigen::Vector3d>(lmp_->domain->boxlo), scene_.packed(),
              [this](int first, int many) { scene_.load(&bodies_, first, many); });
  scene_.load_forces();
  if (!renewed) near_.choose(this->lists(), apart_);
}

/** The candidates among some near pairs. */
template <class Model>
void EllipsoidLoop<Model>::gather(const Pair *pairs, std::size_t count) {
  std::size_t n = 0, strange = 0;
  const PackedGrain *grains = scene_.packed();
  for (std::size_t k = 0; k < count; k++) {  // without a branch: no processor could guess it
    const Pair &coming = pairs[k + AHEAD];
    __builtin_prefetch(coming.history + surface_.lambda);
    apart_.prefetch(coming.j, coming.number);
    __builtin_prefetch(grains[pairs[k].j].x);
    __builtin_prefetch(grains[pairs[k].j].spin);
    __builtin_prefetch(&scene_.force_on(pairs[k].j), 1);
    __builtin_prefetch(pairs[k].history + surface_.lambda + 3, 1);
    const double motion = apart_.moved(pairs[k].i) + apart_.moved(pairs[k].j);
    const bool may_touch = apart_.may_touch(pairs[k].number, motion);
    candidates_[n] = {pairs + k, motion};
    strangers_[strange] = n;
    strange += may_touch && pairs[k].history[surface_.lambda] == 0.0;
    n += may_touch;
  }
  many_ = n;
  if (!bodies_.only_spheres() && !bodies_.some_triaxial()) part_strangers(strange);
}

template <class Model>
template <class Candidates>
inline void EllipsoidLoop<Model>::fill(Candidates candidate, int n) {
  group_.size = n;
  for (int k = 0; k < LANES; k++) {
    const Pair &pair = *candidate(std::min(k, n - 1)).pair;
    group_.i[k] = pair.i;
    group_.j[k] = pair.j;
    group_.history[k] = pair.history + surface_.lambda;
  }
}

/** Pairs that did not touch at the last check usually still do not, and exert no force, so that their order does not
 *  matter. Those that are certainly apart are dropped here, at a fraction of the cost of the solver. */
template <class Model>
void EllipsoidLoop<Model>::part_strangers(std::size_t many) {
  for (std::size_t first = 0; first < many; first += LANES) {
    const std::size_t *numbers = &strangers_[first];
    fill([&](int k) -> const Candidate & { return candidates_[numbers[k]]; },
         static_cast<int>(std::min<std::size_t>(LANES, many - first)));
    part_spheroids(scene_.grains(), group_, geometry_);
    for (int k = 0; k < LANES; k++) {
      if (!geometry_.apart[k]) continue;
      Candidate &candidate = candidates_[numbers[k]];
      bodies_.counts.solved -= geometry_.reachable[k];
      leave(candidate, k);
      candidate.pair = nullptr;
    }
  }
  std::size_t left = many ? strangers_[0] : many_;
  for (std::size_t k = left; k < many_; k++) {
    candidates_[left] = candidates_[k];
    left += candidates_[k].pair != nullptr;
  }
  many_ = left;
}

/** Groups of candidates, in the order of the neighbour list. */
template <class Model>
void EllipsoidLoop<Model>::work_on() {
  for (std::size_t first = 0; first < many_; first += LANES)
    work(&candidates_[first], static_cast<int>(std::min<std::size_t>(LANES, many_ - first)));
}

template <class Model>
void EllipsoidLoop<Model>::work(const Candidate *candidates, int n) {
  meet(candidates, n);
  if (!push(candidates, n)) {
    for (int k = 0; k < n; k++)
      if (geometry_.touching[k]) this->enter(*candidates[k].pair, k);
  }
  if (any(geometry_.met))
    for (int k = 0; k < n; k++)
      if (geometry_.met[k]) apart_.set_touching(candidates[k].pair->number);
  if (any(geometry_.apart))
    for (int k = 0; k < n; k++)
      if (geometry_.apart[k]) leave(candidates[k], k);
}

/** How they lie to each other. */
template <class Model>
void EllipsoidLoop<Model>::meet(const Candidate *candidates, int n) {
  fill([candidates](int k) -> const Candidate & { return candidates[k]; }, n);
  SolverTally uncounted;
  SolverTally &tally = lanes_solve_all_ ? tally_ : uncounted;
  if (bodies_.only_spheres()) meet_round(scene_.grains(), group_, geometry_, tally);
  else meet_spheroids(scene_.grains(), group_, geometry_, tally);
  if (lanes_solve_all_ && !any(geometry_.alone)) return;
  for (int k = 0; k < n; k++) {
    if (!geometry_.reachable[k]) continue;
    if (geometry_.alone[k] || !bodies_.in_lanes(group_.i[k], group_.j[k])) meet_alone(*candidates[k].pair, k);
    else if (!lanes_solve_all_) bodies_.count(geometry_.touching[k], geometry_.steps[k]);
  }
}

/** What no lane can solve. */
template <class Model>
void EllipsoidLoop<Model>::meet_alone(const Pair &pair, int k) {
  const Lanes *d = geometry_.d;
  const EllipsoidBodies::Query query{
      group_.i[k], group_.j[k], {d[0][k], d[1][k], d[2][k]}, surface_.start(pair.history)};
  const EllipsoidContact c = bodies_.solve(query);
  for (int l = 0; l < 3; l++) {
    geometry_.normal[l][k] = c.normal[l];
    geometry_.point[l][k] = c.point[l];
  }
  for (int l = 0; l < 2; l++) {
    geometry_.depth[l][k] = c.depth[l];
    geometry_.curvature[l][k] = c.curvature[l];
  }
  geometry_.lambda[k] = c.lambda;
  geometry_.gap[k] = c.gap;
  geometry_.touching[k] = geometry_.met[k] = c.touching ? -1 : 0;
  geometry_.apart[k] = ~geometry_.touching[k];
}

template <class Model>
void EllipsoidLoop<Model>::approach(int k) {
  const GroupGeometry &g = geometry_;
  EllipsoidContact c{};
  c.touching = true;
  c.lambda = g.lambda[k];
  for (int l = 0; l < 3; l++) {
    c.normal[l] = g.normal[l][k];
    c.point[l] = g.point[l][k];
  }
  for (int l = 0; l < 2; l++) {
    c.depth[l] = g.depth[l][k];
    c.curvature[l] = g.curvature[l][k];
  }
  this->s_.radi = bodies_.equivalent_radius(group_.i[k]);
  this->s_.radj = bodies_.equivalent_radius(group_.j[k]);
  surface_.enter(c, this->s_, bodies_, lmp_->atom);
}

/** Their forces, side by side; false where they must go the host's way, one by one. */
template <class Model>
bool EllipsoidLoop<Model>::push(const Candidate *candidates, int n) {
  const bool round = bodies_.only_spheres();
  const bool softened = surface_.curvature_limit > 0.0 && surface_.curvature_limit < 1.0;
  if (!this->in_lanes() || (round && softened)) return false;
  if (!round && bodies_.some_spheres())
    for (int k = 0; k < n; k++)
      if (bodies_.is_sphere(group_.i[k]) && bodies_.is_sphere(group_.j[k])) return false;
  this->set_law_of_pairs();
  this->push_(scene_.grains(), group_, geometry_, this->group_law_, this->kept_);
  this->follow_up([candidates](int k) -> const Pair & { return *candidates[k].pair; }, n);
  return true;
}

/** A pair that does not touch. */
template <class Model>
inline void EllipsoidLoop<Model>::leave(const Candidate &candidate, int k) {
  const Pair &pair = *candidate.pair;
  apart_.set_apart(pair.number, geometry_.gap[k], candidate.motion);
  if (geometry_.reachable[k]) surface_.forget(pair.history);
  if (*this->flags_of(pair)) this->close(pair);
}

}

#endif

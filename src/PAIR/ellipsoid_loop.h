// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ELLIPSOID_LOOP_H
#define GRAINSCOPE_ELLIPSOID_LOOP_H

#include "box_state.h"
#include "ellipsoid_surface.h"
#include "gran_insitu_models.h"
#include "lane_law.h"
#include "near_pairs.h"
#include "observed_contact_model.h"
#include "packed_scene.h"
#include "tangential_bound.h"
#include "domain.h"
#include "modify.h"
#include "neighbor.h"
#include "fix_insert_stream.h"  // before pair_gran_base.h, which needs it and does not say so
#include "pair_gran_base.h"
#include <algorithm>
#include <cstring>
#include <vector>

namespace grainscope {

using LIGGGHTS::ContactModels::CONTACT_NORMAL_MODEL;
using LIGGGHTS::ContactModels::CONTACT_TANGENTIAL_MODEL;

/** The pair loop of `surface ellipsoid` under gran/insitu: the host's, for what sheared packings need of it, in the
 *  host's order and to the host's last bit, but several contacts side by side, and neighbours that are surely apart are
 *  not looked at. Whatever else is asked of the loop (rigid bodies, multicontact, stored contact forces, compute
 *  pair/gran/local) goes the host's way; contacts whose law is no PairLaw, or that no lane can solve, go it one by
 *  one. */
template <class Model>
class EllipsoidLoop : public LIGGGHTS::PairStyles::Granular<Model>, public ResetsOpenedSprings {
  using Host = LIGGGHTS::PairStyles::Granular<Model>;
  using PairGran = LAMMPS_NS::PairGran;

 public:
  EllipsoidLoop(LAMMPS_NS::LAMMPS *lmp, PairGran *pair, int64_t hash)
      : Host(lmp, pair, hash), lmp_(lmp), pair_(pair),
        reader_(static_cast<LAMMPS_NS::PairGranInsitu *>(pair)->reader()),
        model_(static_cast<Model &>(*reader_.model())),
        law_(static_cast<LAMMPS_NS::PairGranInsitu *>(pair)->lane_law()),
        bodies_(static_cast<LAMMPS_NS::PairGranInsitu *>(pair)->ellipsoid_bodies()),
        surface_(static_cast<LAMMPS_NS::PairGranInsitu *>(pair)->ellipsoid_surface()), scene_(lmp) {}

  void compute_force(PairGran *pair, int eflag, int vflag, int addflag) override {
    const bool rare = pair->storeSumDelta() || pair->storeContactForces() || pair->storeContactForcesStress() ||
                      pair->store_sum_normal_force() || pair->fr_pair() || (pair->cpl() && addflag) ||
                      lmp_->modify->n_fixes_style("insert/stream/predefined");
    bodies_.set_wants_axes(rare);
    if (rare) Host::compute_force(pair, eflag, vflag, addflag);
    else own_compute_force(eflag, vflag);
  }

 private:
  using Pair = NearPairs::Pair;

  /** A pair that is to be looked at. */
  struct Candidate {
    const Pair *pair;
    double motion;  // of its two grains, so far
  };
  static constexpr std::size_t CHUNK = 512;  // candidates at a time: what they ask for stays in the second cache

  void own_compute_force(int eflag, int vflag);
  void follow_motion();
  void set_law();
  void gather(std::size_t first, std::size_t last);
  template <class Candidates>
  void fill(Candidates candidate, int n);
  void part_strangers(std::size_t many);
  void work_on(bool all);
  void work(const Candidate *candidates, int n);
  void meet(const Candidate *candidates, int n);
  void meet_alone(const Pair &pair, int k);
  bool push(const Candidate *candidates, int n);
  void set_law_of_pairs();
  void leave(const Candidate &candidate, int k);
  EllipsoidContact contact_of(int k) const;
  void enter(const Pair &pair, int k, const EllipsoidContact &contact);
  void close(const Pair &pair);
  void tally(const Pair &pair, const double *force, int k);

  LAMMPS_NS::LAMMPS *lmp_;
  PairGran *pair_;
  ContactReader &reader_;
  Model &model_;
  LaneLaw &law_;
  EllipsoidBodies &bodies_;
  const EllipsoidSurface &surface_;

  typename Model::Surfaces s_;
  typename Model::Forces on_i_, on_j_;

  PackedScene scene_;
  SeparationMemory apart_;
  NearPairs near_;
  NeighbourListWatch lists_;
  bool in_lanes_ = false;         // contacts of this evaluation; else they go the host's way
  bool lanes_solve_all_ = false;  // there are no pairs for which that is known not to be
  GroupLaw group_law_{};
  int touched_flags_ = 0;  // that its models set
  std::vector<Candidate> candidates_;
  std::size_t many_ = 0;                // of them
  std::vector<std::size_t> strangers_;  // of them, those that did not touch when they were looked at last
  // pairs that are worked on together
  PairGroup group_;
  GroupGeometry geometry_;
  GroupForces forces_;
  SolverTally tally_;
};

template <class Model>
void EllipsoidLoop<Model>::own_compute_force(int eflag, int vflag) {
  if (eflag || vflag) pair_->ev_setup(eflag, vflag);
  else pair_->evflag = pair_->vflag_fdotr = 0;
  std::memset(static_cast<void *>(&s_), 0, sizeof s_);
  s_.area_ratio = 1.0;
  s_.computeflag = pair_->computeflag();
  s_.shearupdate = pair_->shearupdate();
  model_.beginPass(s_, on_i_, on_j_);
  follow_motion();
  set_law();
  bodies_.counts.listed += near_.listed();
  const std::size_t near = near_.pairs().size();
  for (std::size_t first = 0; first < near; first += CHUNK) {
    gather(first, std::min(first + CHUNK, near));
    work_on(first + CHUNK >= near);
  }
  bodies_.count(tally_);
  tally_ = SolverTally();
  scene_.hand_back_forces();
  model_.endPass(s_, on_i_, on_j_);
}

/** Where all grains are now, and which pairs are near. */
template <class Model>
void EllipsoidLoop<Model>::follow_motion() {
  const LAMMPS_NS::Atom *atom = lmp_->atom;
  const LAMMPS_NS::NeighList *list = pair_->list;
  const int n = atom->nlocal + atom->nghost;
  if (lists_.renewed(*lmp_->neighbor, *lmp_->update)) {
    int pairs = 0;
    for (int ii = 0; ii < list->inum; ii++) pairs += list->numneigh[list->ilist[ii]];
    apart_.restart(n, pairs, lmp_->neighbor->cutneighmax, [this](int i) { return bodies_.elongation(i); });
    near_.restart();
    scene_.restart(bodies_);
  }
  scene_.load(bodies_);
  const BoxState box(lmp_);
  apart_.move(box.edges, Eigen::Map<const Eigen::Vector3d>(lmp_->domain->boxlo), scene_.grains().grains,
              n ? atom->quaternion[0] : nullptr);
  near_.choose(*list, pair_->listgranhistory, pair_->dnum(), apart_);
}

/** What does not change within an evaluation. */
template <class Model>
void EllipsoidLoop<Model>::set_law() {
  // First evaluations of a run are the host's: no spring moves, and damping may be bound.
  const bool first =
      !s_.shearupdate || TangentialBound::get().mode() != TangentialBound::Mode::off || reader_.observer().repeats();
  const bool softened = bodies_.only_spheres() && surface_.curvature_limit > 0.0 && surface_.curvature_limit < 1.0;
  in_lanes_ = !first && !softened && law_.covers();
  lanes_solve_all_ = bodies_.only_spheres() || (!bodies_.some_spheres() && !bodies_.some_triaxial());
  if (!in_lanes_) return;
  law_.refresh();
  group_law_.law = &law_.law();
  group_law_.terms[0] = &law_.terms(1, 1);
  group_law_.frozen = pair_->freeze_group_bit() != 0;
  const bool friction = law_.law().tangential != PairLaw::Tangential::off;
  touched_flags_ = CONTACT_NORMAL_MODEL | (friction ? CONTACT_TANGENTIAL_MODEL : 0);
}

/** The candidates among some near pairs, behind those that are left. */
template <class Model>
void EllipsoidLoop<Model>::gather(std::size_t first, std::size_t last) {
  std::size_t n = many_, strange = 0;
  candidates_.resize(CHUNK + LANES);
  strangers_.resize(CHUNK + LANES);
  const Pair *pairs = near_.pairs().data();
  for (std::size_t k = first; k < last; k++) {  // without a branch: no processor could guess it
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

/** Pairs that did not touch when they were looked at last do not now, as a rule, and exert no force, so that their order
 *  does not matter: those that are surely apart are dropped here, at a fraction of the solver's cost. */
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

/** Groups of candidates, in the order of the neighbour list; the last is worked on only if all are to be. */
template <class Model>
void EllipsoidLoop<Model>::work_on(bool all) {
  const std::size_t whole = all ? many_ : many_ - many_ % LANES;
  for (std::size_t first = 0; first < whole; first += LANES)
    work(&candidates_[first], static_cast<int>(std::min<std::size_t>(LANES, many_ - first)));
  std::copy(candidates_.begin() + whole, candidates_.begin() + many_, candidates_.begin());
  many_ -= whole;
}

template <class Model>
void EllipsoidLoop<Model>::work(const Candidate *candidates, int n) {
  meet(candidates, n);
  if (!in_lanes_ || !push(candidates, n)) {
    for (int k = 0; k < n; k++)
      if (geometry_.touching[k]) enter(*candidates[k].pair, k, contact_of(k));
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
EllipsoidContact EllipsoidLoop<Model>::contact_of(int k) const {
  const GroupGeometry &g = geometry_;
  EllipsoidContact c{};
  c.touching = g.touching[k];
  c.lambda = g.lambda[k];
  c.gap = g.gap[k];
  for (int l = 0; l < 3; l++) {
    c.normal[l] = g.normal[l][k];
    c.point[l] = g.point[l][k];
  }
  for (int l = 0; l < 2; l++) {
    c.depth[l] = g.depth[l][k];
    c.curvature[l] = g.curvature[l][k];
  }
  return c;
}

/** Their forces, side by side; false where one of them must go the host's way. */
template <class Model>
bool EllipsoidLoop<Model>::push(const Candidate *candidates, int n) {
  const bool round = bodies_.only_spheres();
  if (!round && bodies_.some_spheres())
    for (int k = 0; k < n; k++)
      if (bodies_.is_sphere(group_.i[k]) && bodies_.is_sphere(group_.j[k])) return false;
  if (group_law_.frozen || group_law_.law->types > 1) set_law_of_pairs();
  const bool observed = reader_.observer().active(), kept = observed || pair_->evflag;
  (round ? push_round : push_ellipsoids)(scene_.grains(), group_, geometry_, group_law_, kept ? &forces_ : nullptr);
  for (int k = 0; k < n; k++)
    if (geometry_.touching[k]) *candidates[k].pair->flags |= touched_flags_;
  for (int k = 0; k < n && kept; k++) {
    if (!geometry_.touching[k]) continue;
    const Pair &pair = *candidates[k].pair;
    if (observed) {
      const int types[2] = {lmp_->atom->type[pair.i], lmp_->atom->type[pair.j]};
      reader_.after(group_, geometry_, forces_, k, pair.history, types);
    }
    if (pair_->evflag) {
      const double force[3] = {forces_.force[0][k], forces_.force[1][k], forces_.force[2][k]};
      tally(pair, force, k);
    }
  }
  return true;
}

template <class Model>
void EllipsoidLoop<Model>::set_law_of_pairs() {
  const LAMMPS_NS::Atom *atom = lmp_->atom;
  const int freeze = pair_->freeze_group_bit();
  for (int k = 0; k < LANES; k++) {
    const int i = group_.i[k], j = group_.j[k];
    group_law_.terms[k] = &law_.terms(atom->type[i], atom->type[j]);
    group_law_.frozen_i[k] = atom->mask[i] & freeze ? -1 : 0;
    group_law_.frozen_j[k] = atom->mask[j] & freeze ? -1 : 0;
  }
}

/** A pair that does not touch. */
template <class Model>
inline void EllipsoidLoop<Model>::leave(const Candidate &candidate, int k) {
  const Pair &pair = *candidate.pair;
  apart_.set_apart(pair.number, geometry_.gap[k], candidate.motion);
  if (geometry_.reachable[k]) surface_.forget(pair.history);
  if (*pair.flags) close(pair);
}

/** One contact: the model's forces on its two grains. */
template <class Model>
void EllipsoidLoop<Model>::enter(const Pair &pair, int k, const EllipsoidContact &contact) {
  LAMMPS_NS::Atom *atom = lmp_->atom;
  const int i = pair.i, j = pair.j;
  s_.i = i;
  s_.j = j;
  for (int l = 0; l < 3; l++) s_.delta[l] = -geometry_.d[l][k];
  s_.radi = bodies_.equivalent_radius(i);
  s_.radj = bodies_.equivalent_radius(j);
  s_.contact_history = pair.history;
  surface_.enter(contact, s_, bodies_, atom);

  s_.itype = atom->type[i];
  s_.jtype = atom->type[j];
  s_.v_i = atom->v[i];
  s_.v_j = atom->v[j];
  s_.omega_i = atom->omega[i];
  s_.omega_j = atom->omega[j];
  s_.mi = atom->rmass[i];
  s_.mj = atom->rmass[j];
  const int freeze = pair_->freeze_group_bit();
  s_.meff = s_.mi * s_.mj / (s_.mi + s_.mj);
  if (atom->mask[i] & freeze) s_.meff = s_.mj;
  if (atom->mask[j] & freeze) s_.meff = s_.mi;
  s_.radsum = atom->radius[i] + atom->radius[j];
  s_.rsq = geometry_.square[k];
  s_.r = std::sqrt(s_.rsq);
  s_.rinv = 1.0 / s_.r;
  s_.contact_flags = pair.flags;
  s_.has_force_update = true;
  on_i_.reset();
  on_j_.reset();
  model_.surfacesIntersect(s_, on_i_, on_j_);
  model_.endSurfacesIntersect(s_, nullptr, on_i_, on_j_);

  PackedForce &sum_i = scene_.force_on(i), &sum_j = scene_.force_on(j);
  for (int l = 0; l < 3; l++) {
    sum_i.force[l] += on_i_.delta_F[l];
    sum_i.torque[l] += on_i_.delta_torque[l];
    sum_j.force[l] += on_j_.delta_F[l];
    sum_j.torque[l] += on_j_.delta_torque[l];
  }
  if (pair_->evflag) tally(pair, on_i_.delta_F, k);
}

template <class Model>
void EllipsoidLoop<Model>::tally(const Pair &pair, const double *f, int k) {
  const Lanes *d = geometry_.d;
  pair_->ev_tally_xyz(pair.i, pair.j, lmp_->atom->nlocal, 0, 0.0, 0.0, f[0], f[1], f[2], -d[0][k], -d[1][k], -d[2][k]);
}

/** A contact that has opened: the model forgets its springs. */
template <class Model>
inline void EllipsoidLoop<Model>::close(const Pair &pair) {
  s_.i = pair.i;
  s_.j = pair.j;
  s_.itype = lmp_->atom->type[pair.i];
  s_.jtype = lmp_->atom->type[pair.j];
  s_.contact_flags = pair.flags;
  s_.contact_history = pair.history;
  s_.has_force_update = false;
  model_.surfacesClose(s_, on_i_, on_j_);
}

}

#endif

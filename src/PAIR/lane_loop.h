// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_LANE_LOOP_H
#define GRAINSCOPE_LANE_LOOP_H

#include "contact_lanes.h"
#include "gran_insitu_models.h"
#include "lane_law.h"
#include "near_pairs.h"
#include "observed_contact_model.h"
#include "packed_scene.h"
#include "tangential_bound.h"
#include "modify.h"
#include "fix_insert_stream.h"  // before pair_gran_base.h, which needs it and does not say so
#include "pair_gran_base.h"
#include <algorithm>
#include <cstring>

namespace grainscope {

using LIGGGHTS::ContactModels::CONTACT_NORMAL_MODEL;
using LIGGGHTS::ContactModels::CONTACT_TANGENTIAL_MODEL;

/** The pair loops of gran/insitu: the loop of LIGGGHTS, as far as packings need it, in its order and to its last bit,
 *  with several contacts side by side. Everything else (rigid bodies, multicontact, stored contact forces, compute
 *  pair/gran/local) is left to the loop of LIGGGHTS; contacts whose law is not a PairLaw go through its models one by
 *  one. */
template <class Model>
class LaneLoop : public LIGGGHTS::PairStyles::Granular<Model>, public ResetsOpenedSprings {
  using Host = LIGGGHTS::PairStyles::Granular<Model>;

 public:
  using PairGran = LAMMPS_NS::PairGran;

  LaneLoop(LAMMPS_NS::LAMMPS *lmp, PairGran *pair, int64_t hash)
      : Host(lmp, pair, hash), lmp_(lmp), pair_(pair), style_(static_cast<LAMMPS_NS::PairGranInsitu &>(*pair)),
        reader_(style_.reader()), observer_(style_.observer()), model_(static_cast<Model &>(*reader_.model())),
        law_(style_.lane_law()), scene_(lmp) {}

  bool resets_springs() const override { return !asks_for_hosts_loop(); }

  void compute_force(PairGran *pair, int eflag, int vflag, int addflag) override {
    const bool rare = asks_for_hosts_loop() || (pair->cpl() && addflag);
    prepare(rare);
    if (rare) Host::compute_force(pair, eflag, vflag, addflag);
    else own_compute_force(eflag, vflag);
  }

 protected:
  using Pair = NearPairs::Pair;

  /** Whether this loop knows the grains that there are. */
  virtual bool serves() const { return true; }
  /** Before an evaluation, which is the host's or not. */
  virtual void prepare(bool) {}
  /** All contacts, in the order of the neighbour list. */
  virtual void evaluate() = 0;
  /** What the models want to know of contact k of the group, beyond what enter() fills in. */
  virtual void approach(int k) = 0;

  bool in_lanes() const { return in_lanes_; }
  bool observed() const { return observer_.active(); }
  void set_law();
  void set_law_of_pairs();
  /** What follows from the forces of a group: those that touched. pair(k): pair k of the group. */
  template <class PairOf>
  void follow_up(PairOf pair, int n);
  NearPairs::Lists lists() const { return {pair_->list, pair_->listgranhistory, pair_->dnum()}; }
  /** Of the contact history; null without one. */
  int *flags_of(const Pair &pair) const {
    return pair_->listgranhistory ? pair_->listgranhistory->firstneigh[pair.i] + pair.place : nullptr;
  }
  void enter(const Pair &pair, int k);
  void close(const Pair &pair);

  LAMMPS_NS::LAMMPS *lmp_;
  PairGran *pair_;
  LAMMPS_NS::PairGranInsitu &style_;
  ContactReader &reader_;
  ContactObserver &observer_;
  Model &model_;
  LaneLaw &law_;

  typename Model::Surfaces s_;
  typename Model::Forces on_i_, on_j_;

  PackedScene scene_;
  // pairs that are worked on together
  PairGroup group_;
  GroupGeometry geometry_;
  GroupForces forces_;
  GroupLaw group_law_{};
  GroupForces *kept_ = nullptr;  // forces_ where somebody asks for them
  PastLanes past_;
  /** Of these grains, by this law. */
  void (*push_)(const PackedGrains &, const PairGroup &, const GroupGeometry &, const GroupLaw &, GroupForces *);

 private:
  /** For the whole of a run. */
  bool asks_for_hosts_loop() const {
    return pair_->storeSumDelta() || pair_->storeContactForces() || pair_->storeContactForcesStress() ||
           pair_->store_sum_normal_force() || pair_->fr_pair() ||
           lmp_->modify->n_fixes_style("insert/stream/predefined") || !serves();
  }

  bool in_lanes_ = false;  // contacts of this evaluation; else they go the host's way
  int touched_flags_ = 0;  // that the models set

  void own_compute_force(int eflag, int vflag);
  void renew_past(const double *history);
  void tally(const Pair &pair, const double *force, int k);
};

template <class Model>
void LaneLoop<Model>::own_compute_force(int eflag, int vflag) {
  if (eflag || vflag) pair_->ev_setup(eflag, vflag);
  else pair_->evflag = pair_->vflag_fdotr = 0;
  std::memset(static_cast<void *>(&s_), 0, sizeof s_);
  s_.area_ratio = 1.0;
  s_.computeflag = pair_->computeflag();
  s_.shearupdate = pair_->shearupdate();
  model_.beginPass(s_, on_i_, on_j_);
  set_law();
  evaluate();
  scene_.hand_back_forces();
  model_.endPass(s_, on_i_, on_j_);
}

/** What does not change within an evaluation. */
template <class Model>
void LaneLoop<Model>::set_law() {
  // First evaluations of a run are the host's: no spring moves, and damping may be bound.
  const bool first =
      !s_.shearupdate || TangentialBound::get().mode() != TangentialBound::Mode::off || observer_.repeats();
  in_lanes_ = !first && law_.covers();
  kept_ = observed() || pair_->evflag ? &forces_ : nullptr;
  forces_.points = observed() && observer_.needs_records();
  forces_.springs = observed() && observer_.keeps_past();
  forces_.motion = forces_.points || (observed() && observer_.lanes_need_motion());
  if (!in_lanes_) return;
  law_.refresh();
  group_law_.law = &law_.law();
  group_law_.terms[0] = &law_.terms(1, 1);
  group_law_.frozen = pair_->freeze_group_bit() != 0;
  // as the models set them
  touched_flags_ = law_.law().normal == PairLaw::Normal::hertz_stiffness ? 0 : CONTACT_NORMAL_MODEL;
  if (law_.law().tangential != PairLaw::Tangential::off) touched_flags_ |= CONTACT_TANGENTIAL_MODEL;
}

/** What is not the same for all pairs. */
template <class Model>
inline void LaneLoop<Model>::set_law_of_pairs() {
  if (!group_law_.frozen && group_law_.law->types == 1) return;
  const LAMMPS_NS::Atom *atom = lmp_->atom;
  const int freeze = pair_->freeze_group_bit();
  for (int k = 0; k < LANES; k++) {
    const int i = group_.i[k], j = group_.j[k];
    group_law_.terms[k] = &law_.terms(atom->type[i], atom->type[j]);
    group_law_.frozen_i[k] = atom->mask[i] & freeze ? -1 : 0;
    group_law_.frozen_j[k] = atom->mask[j] & freeze ? -1 : 0;
  }
}

template <class Model>
template <class PairOf>
inline void LaneLoop<Model>::follow_up(PairOf pair, int n) {
  if (pair_->listgranhistory)
    for (int k = 0; k < n; k++)
      if (geometry_.touching[k]) *flags_of(pair(k)) |= touched_flags_;
  if (!kept_) return;
  const PastLanes *const past = observed() && observer_.keeps_past() ? &past_ : nullptr;
  if (past) renew_past(pair(0).history);
  if (observed() && observer_.takes_lanes())
    observer_.take({group_, geometry_, forces_, reader_.law(), observer_.time_step(), past});
  const bool records = observed() && observer_.needs_records();
  if (!records && !pair_->evflag) return;
  for (int k = 0; k < n; k++) {
    if (!geometry_.touching[k]) continue;
    if (records) {
      const int types[2] = {lmp_->atom->type[group_.i[k]], lmp_->atom->type[group_.j[k]]};
      reader_.after(group_, geometry_, forces_, k, types);
    }
    if (pair_->evflag) {
      const double force[3] = {forces_.force[0][k], forces_.force[1][k], forces_.force[2][k]};
      tally(pair(k), force, k);
    }
  }
}

/** `history`: that of the first pair. */
template <class Model>
inline void LaneLoop<Model>::renew_past(const double *history) {
  const int first = reader_.law().past_column - static_cast<int>(group_.history[0] - history);
  const PastColumns columns{first, observer_.stamp(), observer_.stamp_before(), 0.5 * observer_.time_step()};
  grainscope::renew_past(group_, geometry_.touching, forces_, columns, past_);
}

/** One contact, pair k of the group: the model's forces on its two grains. */
template <class Model>
void LaneLoop<Model>::enter(const Pair &pair, int k) {
  const LAMMPS_NS::Atom *atom = lmp_->atom;
  const int i = pair.i, j = pair.j;
  s_.i = i;
  s_.j = j;
  for (int l = 0; l < 3; l++) s_.delta[l] = -geometry_.d[l][k];
  s_.contact_history = pair.history;
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
  s_.contact_flags = flags_of(pair);
  s_.has_force_update = true;
  approach(k);
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
void LaneLoop<Model>::tally(const Pair &pair, const double *f, int k) {
  const Lanes *d = geometry_.d;
  pair_->ev_tally_xyz(pair.i, pair.j, lmp_->atom->nlocal, 0, 0.0, 0.0, f[0], f[1], f[2], -d[0][k], -d[1][k], -d[2][k]);
}

/** A contact that has opened: the model forgets its springs. */
template <class Model>
inline void LaneLoop<Model>::close(const Pair &pair) {
  s_.i = pair.i;
  s_.j = pair.j;
  s_.itype = lmp_->atom->type[pair.i];
  s_.jtype = lmp_->atom->type[pair.j];
  s_.contact_flags = flags_of(pair);
  s_.contact_history = pair.history;
  s_.has_force_update = false;
  model_.surfacesClose(s_, on_i_, on_j_);
}

}

#endif

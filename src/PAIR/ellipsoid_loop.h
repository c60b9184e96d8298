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
#include <array>
#include <cstring>

namespace grainscope {

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
    if (rare) Host::compute_force(pair, eflag, vflag, addflag);
    else own_compute_force(eflag, vflag);
  }

 private:
  using Pair = NearPairs::Pair;

  void own_compute_force(int eflag, int vflag);
  void follow_motion();
  const PairLaw *law_in_lanes();
  void work();
  void meet(int n);
  void meet_alone(int k);
  bool push(int n);
  void fill_law(GroupLaw &law) const;
  void enter_one_by_one(int n);
  void leave(int k);
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
  const PairLaw *pair_law_ = nullptr;  // of this evaluation; null where contacts go the host's way
  // pairs that are worked on together
  int many_ = 0;
  std::array<const Pair *, LANES> members_;
  std::array<double, LANES> motions_;  // of their two grains, so far
  PairGroup group_;
  GroupGeometry geometry_;
  GroupForces forces_;
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
  pair_law_ = law_in_lanes();
  bodies_.counts.listed += near_.listed();
  for (const Pair &pair : near_.pairs()) {
    const double motion = apart_.moved(pair.i) + apart_.moved(pair.j);
    members_[many_] = &pair;
    motions_[many_] = motion;
    many_ += apart_.may_touch(pair.number, motion);  // without a branch: no processor could guess it
    if (many_ == LANES) work();
  }
  if (many_) work();
  scene_.hand_back_forces();
  model_.endPass(s_, on_i_, on_j_);
}

/** Where all grains are now, and which pairs are near. */
template <class Model>
void EllipsoidLoop<Model>::follow_motion() {
  const LAMMPS_NS::Atom *atom = lmp_->atom;
  const LAMMPS_NS::NeighList *list = pair_->list;
  if (lists_.renewed(*lmp_->neighbor, *lmp_->update)) {
    int pairs = 0;
    for (int ii = 0; ii < list->inum; ii++) pairs += list->numneigh[list->ilist[ii]];
    apart_.restart(atom->nlocal + atom->nghost, pairs, lmp_->neighbor->cutneighmax);
    near_.restart();
    scene_.restart(bodies_);
  }
  scene_.load(bodies_);
  const BoxState box(lmp_);
  apart_.move(box.edges, Eigen::Map<const Eigen::Vector3d>(lmp_->domain->boxlo), atom->x, atom->quaternion,
              [this](int i) { return bodies_.elongation(i); });
  near_.choose(*list, pair_->listgranhistory, pair_->dnum(), apart_);
}

/** First evaluations of a run are the host's: no spring moves, and damping may be bound. */
template <class Model>
const PairLaw *EllipsoidLoop<Model>::law_in_lanes() {
  const bool first =
      !s_.shearupdate || TangentialBound::get().mode() != TangentialBound::Mode::off || reader_.observer().repeats();
  const bool softened = bodies_.only_spheres() && surface_.curvature_limit > 0.0 && surface_.curvature_limit < 1.0;
  return first || softened || !law_.covers() ? nullptr : &law_.now();
}

/** The pairs that were gathered, in the order of the neighbour list. */
template <class Model>
void EllipsoidLoop<Model>::work() {
  const int n = many_;
  many_ = 0;
  meet(n);
  if (!pair_law_ || !push(n)) enter_one_by_one(n);
  for (int k = 0; k < n; k++)
    if (!geometry_.touching[k]) leave(k);
}

/** How they lie to each other. */
template <class Model>
void EllipsoidLoop<Model>::meet(int n) {
  group_.size = n;
  for (int k = 0; k < LANES; k++) {
    const Pair &pair = *members_[std::min(k, n - 1)];
    group_.i[k] = pair.i;
    group_.j[k] = pair.j;
    group_.history[k] = pair.history + surface_.lambda;
  }
  if (bodies_.only_spheres()) meet_round(scene_.grains(), group_, geometry_);
  else meet_spheroids(scene_.grains(), group_, geometry_);
  for (int k = n; k < LANES; k++) geometry_.touching[k] = geometry_.alone[k] = 0;
  SolverCounts &counts = bodies_.counts;
  const bool some_alone = any(geometry_.alone) || bodies_.some_triaxial() || bodies_.some_spheres();
  for (int k = 0; k < n; k++) {
    if (!geometry_.reachable[k]) continue;
    if (some_alone && (geometry_.alone[k] || !bodies_.in_lanes(group_.i[k], group_.j[k]))) {
      meet_alone(k);
      continue;
    }
    counts.solved++;
    counts.touching -= geometry_.touching[k];
    counts.steps += geometry_.steps[k];
    counts.most_steps = std::max(counts.most_steps, geometry_.steps[k]);
  }
}

/** What no lane can solve. */
template <class Model>
void EllipsoidLoop<Model>::meet_alone(int k) {
  const Lanes *d = geometry_.d;
  const EllipsoidBodies::Query query{
      group_.i[k], group_.j[k], {d[0][k], d[1][k], d[2][k]}, surface_.start(members_[k]->history)};
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
  geometry_.touching[k] = c.touching ? -1 : 0;
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
bool EllipsoidLoop<Model>::push(int n) {
  const bool round = bodies_.only_spheres();
  if (!round && bodies_.some_spheres())
    for (int k = 0; k < n; k++)
      if (bodies_.is_sphere(group_.i[k]) && bodies_.is_sphere(group_.j[k])) return false;
  GroupLaw law{*pair_law_, {}, false, {}, {}};
  fill_law(law);
  const bool observed = reader_.observer().active();
  GroupForces *kept = observed || pair_->evflag ? &forces_ : nullptr;
  (round ? push_round : push_ellipsoids)(scene_.grains(), group_, geometry_, law, kept);
  const int touched =
      LIGGGHTS::ContactModels::CONTACT_NORMAL_MODEL |
      (pair_law_->tangential == PairLaw::Tangential::off ? 0 : LIGGGHTS::ContactModels::CONTACT_TANGENTIAL_MODEL);
  for (int k = 0; k < n; k++) {
    if (!geometry_.touching[k]) continue;
    const Pair &pair = *members_[k];
    *pair.flags |= touched;
    apart_.set_touching(pair.number);
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
inline void EllipsoidLoop<Model>::fill_law(GroupLaw &law) const {
  const LAMMPS_NS::Atom *atom = lmp_->atom;
  law.terms[0] = &law_.terms(1, 1);
  if (pair_law_->types > 1)
    for (int k = 0; k < LANES; k++) law.terms[k] = &law_.terms(atom->type[group_.i[k]], atom->type[group_.j[k]]);
  const int freeze = pair_->freeze_group_bit();
  law.frozen = freeze != 0;
  for (int k = 0; k < LANES && law.frozen; k++) {
    law.frozen_i[k] = atom->mask[group_.i[k]] & freeze ? -1 : 0;
    law.frozen_j[k] = atom->mask[group_.j[k]] & freeze ? -1 : 0;
  }
}

template <class Model>
void EllipsoidLoop<Model>::enter_one_by_one(int n) {
  for (int k = 0; k < n; k++) {
    if (!geometry_.touching[k]) continue;
    enter(*members_[k], k, contact_of(k));
    apart_.set_touching(members_[k]->number);
  }
}

/** A pair that does not touch. */
template <class Model>
inline void EllipsoidLoop<Model>::leave(int k) {
  const Pair &pair = *members_[k];
  apart_.set_apart(pair.number, geometry_.gap[k], motions_[k]);
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

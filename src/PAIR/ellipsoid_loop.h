// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ELLIPSOID_LOOP_H
#define GRAINSCOPE_ELLIPSOID_LOOP_H

#include "box_state.h"
#include "ellipsoid_surface.h"
#include "gran_insitu_models.h"
#include "observed_contact_model.h"
#include "separation_memory.h"
#include "domain.h"
#include "modify.h"
#include "neighbor.h"
#include "fix_insert_stream.h"  // before pair_gran_base.h, which needs it and does not say so
#include "pair_gran_base.h"
#include <cstring>

namespace grainscope {

/** The pair loop of `surface ellipsoid` under gran/insitu: the host's, for what sheared packings need of it, in the
 *  host's order and to the host's last bit, but neighbours that are surely apart are not looked at. Whatever else is
 *  asked of the loop (rigid bodies, multicontact, stored contact forces, compute pair/gran/local) goes the host's
 *  way. */
template <class Model>
class EllipsoidLoop : public LIGGGHTS::PairStyles::Granular<Model>, public ResetsOpenedSprings {
  using Host = LIGGGHTS::PairStyles::Granular<Model>;
  using PairGran = LAMMPS_NS::PairGran;

 public:
  EllipsoidLoop(LAMMPS_NS::LAMMPS *lmp, PairGran *pair, int64_t hash)
      : Host(lmp, pair, hash), lmp_(lmp), pair_(pair),
        model_(static_cast<Model &>(*static_cast<LAMMPS_NS::PairGranInsitu *>(pair)->reader().model())),
        bodies_(static_cast<LAMMPS_NS::PairGranInsitu *>(pair)->ellipsoid_bodies()),
        surface_(static_cast<LAMMPS_NS::PairGranInsitu *>(pair)->ellipsoid_surface()) {}

  void compute_force(PairGran *pair, int eflag, int vflag, int addflag) override {
    const bool rare = pair->storeSumDelta() || pair->storeContactForces() || pair->storeContactForcesStress() ||
                      pair->store_sum_normal_force() || pair->fr_pair() || (pair->cpl() && addflag) ||
                      lmp_->modify->n_fixes_style("insert/stream/predefined");
    if (rare) Host::compute_force(pair, eflag, vflag, addflag);
    else own_compute_force(eflag, vflag);
  }

 private:
  /** What belongs to the neighbours of one grain. */
  struct Lists {
    const int *neighbours;
    int *flags;
    double *history;
    int columns;
    const double *const *x, *radius;
  };
  /** Two neighbours. */
  struct NeighbourPair {
    int i, j;
    double d[3], rsq;  // x_j - x_i
    bool may_touch;    // their bounding spheres do
    int *flags;        // of the contact history, and its columns
    double *history;
    int number;     // of the pair in the neighbour list
    double motion;  // of its two grains, so far
  };
  static constexpr std::size_t BATCH = 512;  // contacts solved at a time: their data stay in the second cache

  void own_compute_force(int eflag, int vflag);
  void spheres();
  void ellipsoids();
  void follow_motion();
  void solve_batch();
  Lists lists_of(int i) const;
  NeighbourPair neighbour(const Lists &lists, int i, int jj) const;
  bool enter(const NeighbourPair &pair, const EllipsoidContact &contact);
  void close(const NeighbourPair &pair);

  LAMMPS_NS::LAMMPS *lmp_;
  PairGran *pair_;
  Model &model_;
  EllipsoidBodies &bodies_;
  const EllipsoidSurface &surface_;

  typename Model::Surfaces s_;
  typename Model::Forces on_i_, on_j_;

  SeparationMemory apart_;
  std::vector<int> first_pair_;  // of each grain in the neighbour list
  NeighbourListWatch lists_;
  std::vector<int> candidates_;  // neighbours of one grain that may touch it, by place in its list
  std::vector<NeighbourPair> to_solve_;
  std::vector<EllipsoidBodies::Query> queries_;
  std::vector<EllipsoidContact> contacts_;
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
  if (bodies_.only_spheres()) spheres();
  else ellipsoids();
  model_.endPass(s_, on_i_, on_j_);
}

/** Grain i and the neighbour of place jj in its list. */
template <class Model>
inline typename EllipsoidLoop<Model>::NeighbourPair EllipsoidLoop<Model>::neighbour(const Lists &lists, int i,
                                                                                    int jj) const {
  NeighbourPair pair;
  pair.i = i;
  pair.j = lists.neighbours[jj] & NEIGHMASK;
  const double *xi = lists.x[i], *xj = lists.x[pair.j];
  pair.rsq = 0.0;
  for (int k = 0; k < 3; k++) {
    pair.d[k] = xj[k] - xi[k];
    pair.rsq += pair.d[k] * pair.d[k];
  }
  const double reach = lists.radius[i] + lists.radius[pair.j];
  pair.may_touch = pair.rsq < reach * reach;
  pair.flags = lists.flags + jj;
  pair.history = lists.history + lists.columns * jj;
  return pair;
}

template <class Model>
inline typename EllipsoidLoop<Model>::Lists EllipsoidLoop<Model>::lists_of(int i) const {
  return {pair_->list->firstneigh[i],
          pair_->listgranhistory->firstneigh[i],
          pair_->listgranhistory->firstdouble[i],
          pair_->dnum(),
          lmp_->atom->x,
          lmp_->atom->radius};
}

/** Nothing but spheres: their distance is all that there is to know. */
template <class Model>
void EllipsoidLoop<Model>::spheres() {
  const LAMMPS_NS::NeighList *list = pair_->list;
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii], neighbours = list->numneigh[i];
    const Lists lists = lists_of(i);
    bodies_.counts.listed += neighbours;
    for (int jj = 0; jj < neighbours; jj++) {
      const NeighbourPair pair = neighbour(lists, i, jj);
      const bool touching = pair.may_touch && enter(pair, bodies_.solve_spheres(i, pair.j, pair.d, pair.rsq));
      if (!touching && *pair.flags) close(pair);
    }
  }
}

template <class Model>
void EllipsoidLoop<Model>::ellipsoids() {
  follow_motion();
  const LAMMPS_NS::NeighList *list = pair_->list;
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii], neighbours = list->numneigh[i];
    const Lists lists = lists_of(i);
    const double moved = apart_.moved(i);
    bodies_.counts.listed += neighbours;
    if (static_cast<int>(candidates_.size()) < neighbours) candidates_.resize(neighbours);
    int n_candidates = 0;  // gathered without a branch: no processor could guess it
    for (int jj = 0; jj < neighbours; jj++) {
      candidates_[n_candidates] = jj;
      n_candidates += apart_.may_touch(first_pair_[ii] + jj, moved + apart_.moved(lists.neighbours[jj] & NEIGHMASK));
    }
    for (int k = 0; k < n_candidates; k++) {
      NeighbourPair pair = neighbour(lists, i, candidates_[k]);
      pair.number = first_pair_[ii] + candidates_[k];
      pair.motion = moved + apart_.moved(pair.j);
      if (pair.may_touch) {
        __builtin_prefetch(pair.history + surface_.lambda);
        __builtin_prefetch(pair.history + lists.columns - 1);
        to_solve_.push_back(pair);
      } else {
        apart_.set_apart(pair.number, std::sqrt(pair.rsq) - lists.radius[i] - lists.radius[pair.j], pair.motion);
        if (*pair.flags) close(pair);
      }
    }
    if (to_solve_.size() >= BATCH) solve_batch();
  }
  solve_batch();
}

template <class Model>
void EllipsoidLoop<Model>::follow_motion() {
  const LAMMPS_NS::Atom *atom = lmp_->atom;
  const LAMMPS_NS::NeighList *list = pair_->list;
  if (lists_.renewed(*lmp_->neighbor, *lmp_->update)) {
    int pairs = 0;
    first_pair_.resize(list->inum);
    for (int ii = 0; ii < list->inum; ii++) {
      first_pair_[ii] = pairs;
      pairs += list->numneigh[list->ilist[ii]];
    }
    apart_.restart(atom->nlocal + atom->nghost, pairs, lmp_->neighbor->cutneighmax);
  }
  const BoxState box(lmp_);
  apart_.move(box.edges, Eigen::Map<const Eigen::Vector3d>(lmp_->domain->boxlo), atom->x, atom->quaternion,
              [this](int i) { return bodies_.elongation(i); });
}

/** The solver's answers, in the order of the neighbour list. */
template <class Model>
void EllipsoidLoop<Model>::solve_batch() {
  const int n = static_cast<int>(to_solve_.size());
  queries_.resize(n);
  contacts_.resize(n);
  for (int k = 0; k < n; k++) {
    const NeighbourPair &pair = to_solve_[k];
    queries_[k] = {pair.i, pair.j, {pair.d[0], pair.d[1], pair.d[2]}, surface_.start(pair.history)};
  }
  bodies_.solve(n, queries_.data(), contacts_.data());
  for (int k = 0; k < n; k++) {
    const NeighbourPair &pair = to_solve_[k];
    if (enter(pair, contacts_[k])) {
      apart_.set_touching(pair.number);
    } else {
      apart_.set_apart(pair.number, contacts_[k].gap, pair.motion);
      if (*pair.flags) close(pair);
    }
  }
  to_solve_.clear();
}

/** One contact: the model's forces on its two grains. False if they do not touch. */
template <class Model>
inline __attribute__((always_inline)) bool EllipsoidLoop<Model>::enter(const NeighbourPair &pair,
                                                                       const EllipsoidContact &contact) {
  LAMMPS_NS::Atom *atom = lmp_->atom;
  const int i = pair.i, j = pair.j;
  s_.i = i;
  s_.j = j;
  for (int k = 0; k < 3; k++) s_.delta[k] = -pair.d[k];
  s_.radi = bodies_.equivalent_radius(i);
  s_.radj = bodies_.equivalent_radius(j);
  s_.contact_history = pair.history;
  if (!surface_.enter(contact, s_, bodies_, atom)) return false;

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
  s_.rsq = pair.rsq;
  s_.r = std::sqrt(s_.rsq);
  s_.rinv = 1.0 / s_.r;
  s_.contact_flags = pair.flags;
  s_.has_force_update = true;
  on_i_.reset();
  on_j_.reset();
  model_.surfacesIntersect(s_, on_i_, on_j_);
  model_.endSurfacesIntersect(s_, nullptr, on_i_, on_j_);

  const bool own_j = j < atom->nlocal;
  if (s_.computeflag) {
    const double relax_i = pair_->relax(i), relax_j = pair_->relax(j);
    double *f_i = atom->f[i], *f_j = atom->f[j], *torque_i = atom->torque[i], *torque_j = atom->torque[j];
    for (int k = 0; k < 3; k++) {
      f_i[k] += relax_i * on_i_.delta_F[k];
      torque_i[k] += relax_i * on_i_.delta_torque[k];
      if (!own_j) continue;
      f_j[k] += relax_j * on_j_.delta_F[k];
      torque_j[k] += relax_j * on_j_.delta_torque[k];
    }
  }
  if (pair_->evflag)
    pair_->ev_tally_xyz(i, j, atom->nlocal, 0, 0.0, 0.0, on_i_.delta_F[0], on_i_.delta_F[1], on_i_.delta_F[2],
                        s_.delta[0], s_.delta[1], s_.delta[2]);
  return true;
}

/** A contact that has opened: the model forgets its springs. */
template <class Model>
inline void EllipsoidLoop<Model>::close(const NeighbourPair &pair) {
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

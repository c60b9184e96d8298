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

/** The pair loop of `surface ellipsoid` under gran/insitu: the host's, for what sheared packings need of it, in the host's order and to
 *  the host's last bit, but neighbours that are surely apart are not looked at. Whatever else is asked of the loop (rigid bodies,
 *  multicontact, stored contact forces, compute pair/gran/local) goes the host's way. */
template <class Model>
class EllipsoidLoop : public LIGGGHTS::PairStyles::Granular<Model>, public ResetsOpenedSprings {
  using Host = LIGGGHTS::PairStyles::Granular<Model>;
  using PairGran = LAMMPS_NS::PairGran;

 public:
  EllipsoidLoop(LAMMPS_NS::LAMMPS *lmp, PairGran *pair, int64_t hash)
      : Host(lmp, pair, hash), lmp_(lmp), pair_(pair), model_(*Model::newest()),
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
  struct Near {
    int i, j;
    double d[3], rsq;  // x_j - x_i
    bool may_touch;    // their bounding spheres do
    int *flags;        // of the contact history, and its columns
    double *history;
    int number;        // of the pair in the neighbour list
    double motion;     // of its two grains, so far
  };
  static constexpr std::size_t BATCH = 512;  // contacts solved at a time: their data stay in the second cache

  void own_compute_force(int eflag, int vflag);
  void spheres();
  void ellipsoids();
  void follow_motion();
  void solve_batch();
  Lists lists_of(int i) const;
  Near neighbour(const Lists &lists, int i, int jj) const;
  bool enter(const Near &near, const EllipsoidContact &contact);
  void close(const Near &near);

  LAMMPS_NS::LAMMPS *lmp_;
  PairGran *pair_;
  Model &model_;
  EllipsoidBodies &bodies_;
  const EllipsoidSurface &surface_;

  typename Model::Sides s_;
  typename Model::Force on_i_, on_j_;

  SeparationMemory apart_;
  std::vector<int> first_pair_;  // of each grain in the neighbour list
  NeighbourListWatch lists_;
  std::vector<int> look_;        // neighbours of one grain that may touch it, by place in its list
  std::vector<Near> near_;
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
inline typename EllipsoidLoop<Model>::Near EllipsoidLoop<Model>::neighbour(const Lists &lists, int i, int jj) const {
  Near near;
  near.i = i;
  near.j = lists.neighbours[jj] & NEIGHMASK;
  const double *xi = lists.x[i], *xj = lists.x[near.j];
  near.rsq = 0.0;
  for (int k = 0; k < 3; k++) {
    near.d[k] = xj[k] - xi[k];
    near.rsq += near.d[k] * near.d[k];
  }
  const double reach = lists.radius[i] + lists.radius[near.j];
  near.may_touch = near.rsq < reach * reach;
  near.flags = lists.flags + jj;
  near.history = lists.history + lists.columns * jj;
  return near;
}

template <class Model>
inline typename EllipsoidLoop<Model>::Lists EllipsoidLoop<Model>::lists_of(int i) const {
  return {pair_->list->firstneigh[i], pair_->listgranhistory->firstneigh[i], pair_->listgranhistory->firstdouble[i], pair_->dnum(),
          lmp_->atom->x, lmp_->atom->radius};
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
      const Near near = neighbour(lists, i, jj);
      const bool touching = near.may_touch && enter(near, bodies_.solve_spheres(i, near.j, near.d, near.rsq));
      if (!touching && *near.flags) close(near);
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
    if (static_cast<int>(look_.size()) < neighbours) look_.resize(neighbours);
    int looks = 0;  // gathered without a branch: no processor could guess it
    for (int jj = 0; jj < neighbours; jj++) {
      look_[looks] = jj;
      looks += apart_.may_touch(first_pair_[ii] + jj, moved + apart_.moved(lists.neighbours[jj] & NEIGHMASK));
    }
    for (int k = 0; k < looks; k++) {
      Near near = neighbour(lists, i, look_[k]);
      near.number = first_pair_[ii] + look_[k];
      near.motion = moved + apart_.moved(near.j);
      if (near.may_touch) {
        __builtin_prefetch(near.history + surface_.lambda);
        __builtin_prefetch(near.history + lists.columns - 1);
        near_.push_back(near);
      } else {
        apart_.set_apart(near.number, std::sqrt(near.rsq) - lists.radius[i] - lists.radius[near.j], near.motion);
        if (*near.flags) close(near);
      }
    }
    if (near_.size() >= BATCH) solve_batch();
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
  const int n = static_cast<int>(near_.size());
  queries_.resize(n);
  contacts_.resize(n);
  for (int k = 0; k < n; k++) {
    const Near &near = near_[k];
    queries_[k] = {near.i, near.j, {near.d[0], near.d[1], near.d[2]}, surface_.start(near.history)};
  }
  bodies_.solve(n, queries_.data(), contacts_.data());
  for (int k = 0; k < n; k++) {
    const Near &near = near_[k];
    if (enter(near, contacts_[k])) {
      apart_.set_touching(near.number);
    } else {
      apart_.set_apart(near.number, contacts_[k].gap, near.motion);
      if (*near.flags) close(near);
    }
  }
  near_.clear();
}

/** One contact: the model's forces on its two grains. False if they do not touch. */
template <class Model>
inline __attribute__((always_inline)) bool EllipsoidLoop<Model>::enter(const Near &near, const EllipsoidContact &contact) {
  LAMMPS_NS::Atom *atom = lmp_->atom;
  const int i = near.i, j = near.j;
  s_.i = i;
  s_.j = j;
  for (int k = 0; k < 3; k++) s_.delta[k] = -near.d[k];
  s_.radi = bodies_.equivalent_radius(i);
  s_.radj = bodies_.equivalent_radius(j);
  s_.contact_history = near.history;
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
  s_.rsq = near.rsq;
  s_.r = std::sqrt(s_.rsq);
  s_.rinv = 1.0 / s_.r;
  s_.contact_flags = near.flags;
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
    pair_->ev_tally_xyz(i, j, atom->nlocal, 0, 0.0, 0.0, on_i_.delta_F[0], on_i_.delta_F[1], on_i_.delta_F[2], s_.delta[0], s_.delta[1],
                        s_.delta[2]);
  return true;
}

/** A contact that has opened: the model forgets its springs. */
template <class Model>
inline void EllipsoidLoop<Model>::close(const Near &near) {
  s_.i = near.i;
  s_.j = near.j;
  s_.itype = lmp_->atom->type[near.i];
  s_.jtype = lmp_->atom->type[near.j];
  s_.contact_flags = near.flags;
  s_.contact_history = near.history;
  s_.has_force_update = false;
  model_.surfacesClose(s_, on_i_, on_j_);
}

}

#endif

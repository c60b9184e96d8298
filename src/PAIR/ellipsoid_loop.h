// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ELLIPSOID_LOOP_H
#define GRAINSCOPE_ELLIPSOID_LOOP_H

#include "box_state.h"
#include "ellipsoid_surface.h"
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
class EllipsoidLoop : public LIGGGHTS::PairStyles::Granular<Model> {
  using Host = LIGGGHTS::PairStyles::Granular<Model>;
  using PairGran = LAMMPS_NS::PairGran;

 public:
  EllipsoidLoop(LAMMPS_NS::LAMMPS *lmp, PairGran *pair, int64_t hash)
      : Host(lmp, pair, hash), lmp_(lmp), model_(*Model::newest()),
        bodies_(static_cast<LAMMPS_NS::PairGranInsitu *>(pair)->ellipsoid_bodies()),
        surface_(static_cast<LAMMPS_NS::PairGranInsitu *>(pair)->ellipsoid_surface()) {}

  void compute_force(PairGran *pair, int eflag, int vflag, int addflag) override {
    const bool rare = pair->storeSumDelta() || pair->storeContactForces() || pair->storeContactForcesStress() ||
                      pair->store_sum_normal_force() || pair->fr_pair() || (pair->cpl() && addflag) ||
                      lmp_->modify->n_fixes_style("insert/stream/predefined");
    if (rare) Host::compute_force(pair, eflag, vflag, addflag);
    else own_compute_force(pair, eflag, vflag);
  }

 private:
  using Sides = typename Model::Sides;
  using Force = typename Model::Force;

  /** A pair that the solver must look at. */
  struct Near {
    int number;     // in the neighbour list
    double motion;  // of its two grains, so far
    double rsq;
    int *flags;
    double *history;
  };
  static constexpr std::size_t BATCH = 512;  // about what the first cache holds

  void own_compute_force(PairGran *pair, int eflag, int vflag);
  void follow_motion(PairGran *pair);
  void close(const Near &near, int i, int j, Sides &s, Force &on_i, Force &on_j);
  void contacts_of_batch(PairGran *pair, Sides &s, Force &on_i, Force &on_j);

  LAMMPS_NS::LAMMPS *lmp_;
  Model &model_;
  EllipsoidBodies &bodies_;
  const EllipsoidSurface &surface_;
  std::vector<int> look_;  // neighbours of one grain, by place in its list
  std::vector<Near> near_;
  std::vector<EllipsoidBodies::Query> queries_;
  std::vector<EllipsoidContact> contacts_;
  SeparationMemory apart_;
  std::vector<int> first_pair_;  // of each grain in the neighbour list
  LAMMPS_NS::bigint list_ = -1;
};

template <class Model>
void EllipsoidLoop<Model>::follow_motion(PairGran *pair) {
  const LAMMPS_NS::Atom *atom = lmp_->atom;
  const LAMMPS_NS::Neighbor *neighbor = lmp_->neighbor;
  const LAMMPS_NS::NeighList *list = pair->list;
  if (neighbor->ago == 0 || list_ != neighbor->lastcall) {
    list_ = neighbor->lastcall;
    int pairs = 0;
    first_pair_.resize(list->inum);
    for (int ii = 0; ii < list->inum; ii++) {
      first_pair_[ii] = pairs;
      pairs += list->numneigh[list->ilist[ii]];
    }
    apart_.restart(atom->nlocal + atom->nghost, pairs, neighbor->cutneighmax);
  }
  const BoxState box(lmp_);
  apart_.move(box.edges, Eigen::Map<const Eigen::Vector3d>(lmp_->domain->boxlo), atom->x, atom->quaternion,
              [this](int i) { return bodies_.elongation(i); });
}

template <class Model>
void EllipsoidLoop<Model>::own_compute_force(PairGran *pair, int eflag, int vflag) {
  if (eflag || vflag) pair->ev_setup(eflag, vflag);
  else pair->evflag = pair->vflag_fdotr = 0;

  Sides s;
  Force on_i, on_j;
  std::memset(static_cast<void *>(&s), 0, sizeof s);
  s.area_ratio = 1.0;
  s.computeflag = pair->computeflag();
  s.shearupdate = pair->shearupdate();
  model_.beginPass(s, on_i, on_j);
  follow_motion(pair);

  const LAMMPS_NS::NeighList *list = pair->list, *kept = pair->listgranhistory;
  double **x = lmp_->atom->x;
  const double *radius = lmp_->atom->radius;
  const int dnum = pair->dnum();
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii], neighbours = list->numneigh[i];
    const int *jlist = list->firstneigh[i];
    const double moved = apart_.moved(i);
    bodies_.counts.listed += neighbours;
    if (static_cast<int>(look_.size()) < neighbours) look_.resize(neighbours);
    int looks = 0;  // gathered without a branch: no processor could guess it
    for (int jj = 0; jj < neighbours; jj++) {
      look_[looks] = jj;
      looks += apart_.may_touch(first_pair_[ii] + jj, moved + apart_.moved(jlist[jj] & NEIGHMASK));
    }
    for (int l = 0; l < looks; l++) {
      const int jj = look_[l], j = jlist[jj] & NEIGHMASK, number = first_pair_[ii] + jj;
      const double motion = moved + apart_.moved(j);
      const double d[3] = {x[j][0] - x[i][0], x[j][1] - x[i][1], x[j][2] - x[i][2]};
      const double rsq = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], radsum = radius[i] + radius[j];
      Near near{number, motion, rsq, &kept->firstneigh[i][jj], &kept->firstdouble[i][dnum * jj]};
      if (rsq >= radsum * radsum) {
        apart_.set_apart(number, std::sqrt(rsq) - radsum, motion);
        if (*near.flags) close(near, i, j, s, on_i, on_j);
        continue;
      }
      __builtin_prefetch(near.history);
      __builtin_prefetch(near.history + dnum - 1);
      near_.push_back(near);
      queries_.push_back({i, j, {d[0], d[1], d[2]}, 0.0});
    }
    if (near_.size() >= BATCH || ii == list->inum - 1) contacts_of_batch(pair, s, on_i, on_j);
  }
  model_.endPass(s, on_i, on_j);
}

template <class Model>
void EllipsoidLoop<Model>::close(const Near &near, int i, int j, Sides &s, Force &on_i, Force &on_j) {
  s.i = i;
  s.j = j;
  s.itype = lmp_->atom->type[i];
  s.jtype = lmp_->atom->type[j];
  s.contact_flags = near.flags;
  s.contact_history = near.history;
  model_.surfacesClose(s, on_i, on_j);
}

/** The solver's answers, in the order of the neighbour list. */
template <class Model>
void EllipsoidLoop<Model>::contacts_of_batch(PairGran *pair, Sides &s, Force &on_i, Force &on_j) {
  LAMMPS_NS::Atom *atom = lmp_->atom;
  const int *type = atom->type, *mask = atom->mask;
  const int nlocal = atom->nlocal, freeze = pair->freeze_group_bit();
  double **f = atom->f, **torque = atom->torque;

  const int n = static_cast<int>(near_.size());
  contacts_.resize(n);
  for (int k = 0; k < n; k++) queries_[k].start = surface_.start(near_[k].history);
  bodies_.solve(n, queries_.data(), contacts_.data());
  for (int k = 0; k < n; k++) {
    const Near &near = near_[k];
    const int i = queries_[k].i, j = queries_[k].j;
    s.contact_history = near.history;
    for (int c = 0; c < 3; c++) s.delta[c] = -queries_[k].d[c];
    s.i = i;
    s.j = j;
    s.radi = bodies_.equivalent_radius(i);
    s.radj = bodies_.equivalent_radius(j);
    if (!surface_.enter(contacts_[k], s, bodies_, atom)) {
      apart_.set_apart(near.number, contacts_[k].gap, near.motion);
      if (*near.flags) close(near, i, j, s, on_i, on_j);
      continue;
    }
    apart_.set_touching(near.number);

    s.itype = type[i];
    s.jtype = type[j];
    s.v_i = atom->v[i];
    s.v_j = atom->v[j];
    s.omega_i = atom->omega[i];
    s.omega_j = atom->omega[j];
    s.mi = atom->rmass[i];
    s.mj = atom->rmass[j];
    s.meff = s.mi * s.mj / (s.mi + s.mj);
    if (mask[i] & freeze) s.meff = s.mj;
    if (mask[j] & freeze) s.meff = s.mi;
    s.radsum = atom->radius[i] + atom->radius[j];
    s.rsq = near.rsq;
    s.r = std::sqrt(s.rsq);
    s.rinv = 1.0 / s.r;
    s.contact_flags = near.flags;
    on_i.reset();
    on_j.reset();
    model_.surfacesIntersect(s, on_i, on_j);
    model_.endSurfacesIntersect(s, nullptr, on_i, on_j);

    if (s.computeflag) {
      const double relax_i = pair->relax(i), relax_j = pair->relax(j);
      for (int c = 0; c < 3; c++) {
        f[i][c] += relax_i * on_i.delta_F[c];
        torque[i][c] += relax_i * on_i.delta_torque[c];
        if (j >= nlocal) continue;
        f[j][c] += relax_j * on_j.delta_F[c];
        torque[j][c] += relax_j * on_j.delta_torque[c];
      }
    }
    if (pair->evflag)
      pair->ev_tally_xyz(i, j, nlocal, 0, 0.0, 0.0, on_i.delta_F[0], on_i.delta_F[1], on_i.delta_F[2], s.delta[0], s.delta[1], s.delta[2]);
  }
  near_.clear();
  queries_.clear();
}

}

#endif

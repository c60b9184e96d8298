// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ELLIPSOID_LOOP_H
#define GRAINSCOPE_ELLIPSOID_LOOP_H

#include "box_state.h"
#include "ellipsoid_bodies.h"
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
        bodies_(static_cast<LAMMPS_NS::PairGranInsitu *>(pair)->ellipsoid_bodies()) {}

  void compute_force(PairGran *pair, int eflag, int vflag, int addflag) override {
    const bool rare = pair->storeSumDelta() || pair->storeContactForces() || pair->storeContactForcesStress() ||
                      pair->store_sum_normal_force() || pair->fr_pair() || (pair->cpl() && addflag) ||
                      lmp_->modify->n_fixes_style("insert/stream/predefined");
    if (rare) Host::compute_force(pair, eflag, vflag, addflag);
    else own_compute_force(pair, eflag, vflag);
  }

 private:
  void own_compute_force(PairGran *pair, int eflag, int vflag);
  void follow_motion(PairGran *pair);

  LAMMPS_NS::LAMMPS *lmp_;
  Model &model_;
  EllipsoidBodies &bodies_;
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

  const LAMMPS_NS::Atom *atom = lmp_->atom;
  double **x = atom->x, **v = atom->v, **f = atom->f, **omega = atom->omega, **torque = atom->torque;
  const double *radius = atom->radius, *rmass = atom->rmass;
  const int *type = atom->type, *mask = atom->mask;
  const int nlocal = atom->nlocal, dnum = pair->dnum(), freeze = pair->freeze_group_bit();
  const LAMMPS_NS::NeighList *list = pair->list, *kept = pair->listgranhistory;

  LIGGGHTS::ContactModels::SurfacesIntersectData s;
  LIGGGHTS::ContactModels::ForceData on_i, on_j;
  std::memset(static_cast<void *>(&s), 0, sizeof s);
  s.is_wall = false;
  s.area_ratio = 1.0;
  s.computeflag = pair->computeflag();
  s.shearupdate = pair->shearupdate();
  model_.beginPass(s, on_i, on_j);
  follow_motion(pair);

  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii], first = first_pair_[ii], neighbours = list->numneigh[i];
    const int *jlist = list->firstneigh[i];
    const double moved = apart_.moved(i);
    bodies_.counts.listed += neighbours;
    s.i = i;
    s.itype = type[i];
    s.v_i = v[i];
    s.omega_i = omega[i];
    s.radi = bodies_.equivalent_radius(i);

    for (int jj = 0; jj < neighbours; jj++) {
      const int j = jlist[jj] & NEIGHMASK;
      const double motion = moved + apart_.moved(j);
      if (!apart_.may_touch(first + jj, motion)) continue;

      int *flags = kept ? &kept->firstneigh[i][jj] : nullptr;
      s.j = j;
      s.jtype = type[j];
      s.v_j = v[j];
      s.omega_j = omega[j];
      s.radj = bodies_.equivalent_radius(j);
      s.radsum = radius[i] + radius[j];
      s.mi = rmass[i];
      s.mj = rmass[j];
      s.rsq = 0.0;
      for (int k = 0; k < 3; k++) {
        s.delta[k] = x[i][k] - x[j][k];
        s.rsq += s.delta[k] * s.delta[k];
      }
      s.contact_flags = flags;
      s.contact_history = kept ? &kept->firstdouble[i][dnum * jj] : nullptr;
      on_i.reset();
      on_j.reset();

      const bool near = s.rsq < s.radsum * s.radsum;
      if (!near || !model_.checkSurfaceIntersect(s)) {
        apart_.set_apart(first + jj, near ? -s.deltan : std::sqrt(s.rsq) - s.radsum, motion);
        s.has_force_update = false;
        if (flags && *flags) model_.surfacesClose(s, on_i, on_j);
        continue;
      }
      apart_.set_touching(first + jj);

      s.r = std::sqrt(s.rsq);
      s.rinv = 1.0 / s.r;
      s.meff = s.mi * s.mj / (s.mi + s.mj);
      if (mask[i] & freeze) s.meff = s.mj;
      if (mask[j] & freeze) s.meff = s.mi;
      model_.surfacesIntersect(s, on_i, on_j);
      model_.endSurfacesIntersect(s, nullptr, on_i, on_j);
      s.has_force_update = true;

      if (s.computeflag) {
        const double relax_i = pair->relax(i), relax_j = pair->relax(j);
        for (int k = 0; k < 3; k++) {
          f[i][k] += relax_i * on_i.delta_F[k];
          torque[i][k] += relax_i * on_i.delta_torque[k];
          if (j >= nlocal) continue;
          f[j][k] += relax_j * on_j.delta_F[k];
          torque[j][k] += relax_j * on_j.delta_torque[k];
        }
      }
      if (pair->evflag)
        pair->ev_tally_xyz(i, j, nlocal, 0, 0.0, 0.0, on_i.delta_F[0], on_i.delta_F[1], on_i.delta_F[2], s.delta[0], s.delta[1], s.delta[2]);
    }
  }
  model_.endPass(s, on_i, on_j);
}

}

#endif

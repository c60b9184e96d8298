// SPDX-License-Identifier: GPL-2.0-or-later
#include "time_step_watch.h"
#include "bodies.h"
#include "grain_shape.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "update.h"
#include <cstdio>

namespace grainscope {

namespace {

const int steps_between_checks = 1000;

}

void TimeStepWatch::begin_run() {
  level_ = Level::none;
  grains_next_ = false;
  clumps_ = has_bodies(lmp);
}

bool TimeStepWatch::wants_contacts() {
  level_ = Level::none;
  if (clumps_) return false;
  if (++steps_ < steps_between_checks && !grains_next_) return false;
  level_ = grains_next_ ? Level::grains : Level::contacts;
  grains_next_ = false;
  steps_ = 0;
  return true;
}

void TimeStepWatch::begin_contacts() {
  largest_ = 0.0;
  damped_ = 0;
  grains_.assign(level_ == Level::grains ? atom->nlocal : 0, time_step::GrainModes());
}

void TimeStepWatch::add_contacts(ContactSpan contacts) {
  for (const Contact &c : contacts) {
    if (level_ == Level::contacts) {
      const double mi = atom->rmass[c.i], mj = c.with_wall() ? 0.0 : atom->rmass[c.j()];
      largest_ = std::max(largest_, time_step::of_contact(c, c.with_wall() ? mi : mi * mj / (mi + mj), update->dt));
      continue;
    }
    const Eigen::Vector3d &arm = c.motion->arm;
    if (c.motion->tangential_damping > 0.0) damped_ = 1;
    grains_[c.i].add(c, arm);
    if (c.with_own_grain()) grains_[c.j()].add(c, arm + c.branch);
  }
}

void TimeStepWatch::end_contacts() {
  if (level_ == Level::contacts) evaluate_contacts();
  if (level_ == Level::grains) evaluate_grains();
  level_ = Level::none;
}

void TimeStepWatch::evaluate_contacts() {
  MPI_Allreduce(MPI_IN_PLACE, &largest_, 1, MPI_DOUBLE, MPI_MAX, world);
  grains_next_ = largest_ >= time_step::harmless;
}

void TimeStepWatch::evaluate_grains() {
  time_step::GrainModes::Mode worst;
  for (int i = 0; i < atom->nlocal; i++) {
    if (domain->dimension == 2) grains_[i].confine_to_plane();
    const time_step::GrainModes::Mode mode =
        grains_[i].fastest(atom->rmass[i], inertia_tensor(*atom, i, domain->dimension), update->dt);
    if (mode.value > worst.value) worst = mode;
  }
  grains_.clear();
  struct {
    double value;
    int rank;
  } largest = {worst.value, comm->me};
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE_INT, MPI_MAXLOC, world);
  if (largest.value <= std::max(time_step::limit, 2.0 * warned_of_)) return;
  warned_of_ = largest.value;
  MPI_Allreduce(MPI_IN_PLACE, &damped_, 1, MPI_INT, MPI_MAX, world);
  double step = worst.value > 0.0 ? worst.largest_step() : 0.0;
  MPI_Bcast(&step, 1, MPI_DOUBLE, largest.rank, world);
  if (comm->me != 0) return;
  char message[512];
  snprintf(message, sizeof message,
           "pair_style gran/insitu: the time step %g is too long for the stiffest contacts: b = dt^2 K + 2 dt C over "
           "the mass is %.3g, limit %g: "
           "energy may be created%s. Use a time step below %.3g%s (doc/stability.md)",
           update->dt, largest.value, time_step::limit,
           damped_ ? ", and tangential damping hides it in the motion" : "", step,
           damped_ ? ", or 'tangential_damping off'" : "");
  error->warning(FLERR, message);
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_ledger_record.h"
#include "box_state.h"
#include "contact_observer.h"
#include "pair_gran_insitu.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "group.h"
#include "modify.h"
#include "update.h"
#include <cstring>
#include <initializer_list>

using namespace LAMMPS_NS;
using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using grainscope::BoxState;
using grainscope::Contact;
using grainscope::ContactObserver;
using grainscope::EnergyLedger;

namespace {

bool one_of(const char *style, std::initializer_list<const char *> styles) {
  for (const char *one : styles)
    if (!strcmp(style, one)) return true;
  return false;
}

/** Rotation from the frame of a grain's principal axes into the laboratory's. */
Matrix3d rotation(const double q[4]) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  Matrix3d r;
  r << w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y),
       2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x),
       2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z;
  return r;
}

}

FixLedgerRecord::FixLedgerRecord(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  if (narg != 4) error->all(FLERR, "fix ledger/record: is made by the computes that need it, not by an input script");
  name_ = arg[3];
  restart_global = 1;
}

int FixLedgerRecord::setmask() { return FixConst::PRE_INITIAL_INTEGRATE | FixConst::PRE_FINAL_INTEGRATE; }

void FixLedgerRecord::fail(const std::string &message) const {
  error->all(FLERR, (name_ + ": " + message).c_str());
  std::abort();  // not reached: error->all ends the run
}

void FixLedgerRecord::require_known_models() const {
  const std::string got = ", got '" + pair_->models() + "'";
  const auto matches = [this](const char *kind, std::initializer_list<const char *> models) {
    for (const char *model : models)
      if (pair_->contact_match(kind, model)) return true;
    return false;
  };
  if (!pair_->observer().elastic()) fail("knows the energy of the normal models hertz, hooke, hertz/stiffness and hooke/stiffness only" + got);
  if (pair_->observer().law() == ContactObserver::TangentialLaw::other) fail("knows the energy of 'tangential' off, no_history and history only" + got);
  if (!matches("cohesion", {"off"})) fail("does not know the energy of cohesion" + got);
  if (!matches("rolling_friction", {"off", "cdt", "epsd", "epsd2"})) fail("knows the work of 'rolling_friction' off, cdt, epsd and epsd2 only" + got);
  if (!matches("surface", {"default", "superquadric", "ellipsoid"})) fail("knows 'surface' default, superquadric and ellipsoid only" + got);
}

/** Kinetic energy is booked as velocity Verlet moves it: every grain of the group by one such fix, or not at all (frozen). */
void FixLedgerRecord::require_moved_by_verlet() const {
  int moved = 0;
  for (int k = 0; k < modify->nfix; k++) {
    const Fix *fix = modify->fix[k];
    if (one_of(fix->style, {"nve/sphere", "nve/superquadric", "nve/spheroid", "freeze"})) {
      moved |= fix->groupbit;
    } else if (fix->time_integrate || fix->rigid_flag || strstr(fix->style, "multisphere") || !strncmp(fix->style, "move", 4)) {
      if (group->count(fix->igroup) > 0)
        fail(std::string("knows grains that are moved by fix nve/sphere, nve/superquadric or nve/spheroid, or frozen, got fix ") + fix->id + " of style " +
             fix->style);
    }
  }
  int loose = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & groupbit) && !(atom->mask[i] & moved)) loose = 1;
  MPI_Allreduce(MPI_IN_PLACE, &loose, 1, MPI_INT, MPI_MAX, world);
  if (loose) fail("every grain of the group must be moved by fix nve/sphere, nve/superquadric or nve/spheroid, or be frozen; some are not");
}

void FixLedgerRecord::require_flowing_box() const {
  if (domain->box_change && !domain->deform_vremap) fail("needs a box that carries velocities along where it deforms: 'remap v' in fix deform");
  if (domain->deform_vremap && domain->deform_groupbit != 1) fail("needs fix deform to be of the group all");
}

void FixLedgerRecord::init() {
  pair_ = PairGranInsitu::required_by(lmp, name_.c_str());
  ContactObserver &observer = pair_->observer();
  if (!observer.knows_past())
    fail("needs 'ledger on' in pair_style gran/insitu, which remembers what each contact stored, got '" + pair_->models() + "'");
  require_known_models();
  require_moved_by_verlet();
  require_flowing_box();
  using Law = ContactObserver::TangentialLaw;
  const bool history = observer.law() == Law::history;
  ledger_.set_law({pair_->stressStrainExponent(), history, history || observer.law() == Law::no_history, observer.rolls()});
  observer.add(this);
  arrived_ = 0.0;
  stepping_ = false;
}

void FixLedgerRecord::begin_contacts() { ledger_.begin_evaluation(atom->nlocal); }

void FixLedgerRecord::add_contact(const Contact &c) {
  if (atom->mask[c.i] & atom->mask[c.j] & groupbit) ledger_.add(c, update->dt, pair_->observer().springs_move());
}

grainscope::LedgerFrame FixLedgerRecord::frame() const {
  const BoxState box(lmp);
  return {box.velocity_gradient, box.centre, box.edges.diagonal(), box.edge_velocities.diagonal()};
}

/** `starting`: at the beginning of a step, where rates of change are asked for. */
EnergyLedger::Grain FixLedgerRecord::grain(int i, bool starting) const {
  EnergyLedger::Grain g;
  g.index = i;
  g.mass = atom->rmass[i];
  g.x = Map<const Vector3d>(atom->x[i]);
  g.v = Map<const Vector3d>(atom->v[i]);
  g.omega = Map<const Vector3d>(atom->omega[i]);
  g.force = Map<const Vector3d>(atom->f[i]);
  g.torque = Map<const Vector3d>(atom->torque[i]);
  if (!atom->superquadric_flag) {
    const double inertia = (domain->dimension == 2 ? 0.5 : 0.4) * g.mass * atom->radius[i] * atom->radius[i];
    g.angular_momentum = inertia * g.omega;
    g.spin_up = g.torque / inertia;
  } else {
    g.angular_momentum = Map<const Vector3d>(atom->angmom[i]);
    if (!starting) return g;
    // From the angular momentum, which the integrators keep: the host's `velocity setAngular` leaves omega at odds with it.
    const Matrix3d r = rotation(atom->quaternion[i]);
    const Map<const Vector3d> inertia(atom->inertia[i]);
    g.omega = r * (r.transpose() * g.angular_momentum).cwiseQuotient(inertia);
    g.spin_up = r * (r.transpose() * g.torque).cwiseQuotient(inertia);
  }
  return g;
}

void FixLedgerRecord::pre_initial_integrate() {
  ledger_.begin_start_of_step(frame());
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    ledger_.start_of_step(grain(i, true), update->dt);
    arrived_ -= 1.0;
  }
  ledger_.book_start(update->dt);
  stepping_ = true;
}

void FixLedgerRecord::pre_final_integrate() {
  ledger_.begin_end_of_step();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    ledger_.end_of_step(grain(i, false), update->dt);
    arrived_ += 1.0;
  }
  ledger_.book_step(update->dt);
  stepping_ = false;
}

FixLedgerRecord::Account FixLedgerRecord::account() const {
  using E = EnergyLedger;
  Account sum;
  double values[2 * E::entries + 2 * E::stores + 2], *at = values;
  const auto put = [&at](const auto &numbers) { for (double one : numbers) *at++ = one; };
  put(ledger_.totals());
  put(ledger_.last());
  put(ledger_.stored());
  put(ledger_.stored_before());
  *at++ = ledger_.start_energy();
  *at++ = stepping_ ? 0.0 : arrived_;
  MPI_Allreduce(MPI_IN_PLACE, values, at - values, MPI_DOUBLE, MPI_SUM, world);
  at = values;
  const auto take = [&at](auto &numbers) { for (double &one : numbers) one = *at++; };
  take(sum.totals);
  take(sum.last);
  take(sum.stored);
  take(sum.change);
  if (at[1] != 0.0)
    fail("the group changed by " + std::to_string(static_cast<long>(at[1])) + " grains in the middle of a run: the ledger follows grains that stay");
  double change = 0.0, last_change = 0.0;
  for (int k = 0; k < E::stores; k++) {
    change += sum.stored[k];
    sum.change[k] = sum.stored[k] - sum.change[k];
    last_change += sum.change[k];
  }
  sum.residual = E::residual(sum.totals, change - *at);
  sum.last_residual = E::residual(sum.last, last_change);
  return sum;
}

std::string FixLedgerRecord::id_for(const char *compute) { return std::string(compute) + "_ledger"; }

FixLedgerRecord *FixLedgerRecord::make(LAMMPS *lmp, const char *id, int igroup) {
  const std::string record = id_for(id);
  if (lmp->modify->find_fix(record.c_str()) >= 0)
    lmp->error->all(FLERR, ("compute " + std::string(id) + " needs the fix ID '" + record + "' for its ledger, but it is taken").c_str());
  const std::string words[4] = {record, lmp->group->names[igroup], "ledger/record", std::string("compute ") + id};
  char *arg[4];
  for (int k = 0; k < 4; k++) arg[k] = const_cast<char *>(words[k].c_str());
  lmp->modify->add_fix(4, arg);
  return find(lmp, id);
}

FixLedgerRecord *FixLedgerRecord::find(LAMMPS *lmp, const char *id) {
  const std::string record = id_for(id);
  const int found = lmp->modify->find_fix(record.c_str());
  FixLedgerRecord *fix = found < 0 ? nullptr : dynamic_cast<FixLedgerRecord *>(lmp->modify->fix[found]);
  if (!fix)
    lmp->error->all(FLERR, ("fix " + record + ", which keeps the ledger of compute " + id + ", is gone: uncompute it and compute again").c_str());
  return fix;
}

void FixLedgerRecord::forget(LAMMPS *lmp, const char *compute) {
  const std::string id = id_for(compute);
  const int found = lmp->modify->nfix ? lmp->modify->find_fix(id.c_str()) : -1;
  if (found >= 0 && dynamic_cast<FixLedgerRecord *>(lmp->modify->fix[found])) lmp->modify->delete_fix(id.c_str());
}

/** Summed over ranks, so that any number of them may continue. */
void FixLedgerRecord::write_restart(FILE *file) {
  auto state = ledger_.state();
  MPI_Allreduce(MPI_IN_PLACE, state.data(), state.size(), MPI_DOUBLE, MPI_SUM, world);
  if (comm->me != 0) return;
  const int size = state.size() * sizeof(double);
  fwrite(&size, sizeof size, 1, file);
  fwrite(state.data(), 1, size, file);
}

void FixLedgerRecord::restart(char *buffer) {
  std::array<double, EnergyLedger::state_size> state{};
  if (comm->me == 0) memcpy(state.data(), buffer, sizeof state);
  ledger_.restore(state);
}

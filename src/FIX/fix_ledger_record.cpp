// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_ledger_record.h"
#include "arguments.h"
#include "box_state.h"
#include "contact_observer.h"
#include "grain_shape.h"
#include "ledger_account.h"
#include "pair_gran_insitu.h"
#include "spheroid_rotation.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "group.h"
#include "modify.h"
#include "update.h"
#include <cstring>
#include <initializer_list>
#include <memory>

using namespace LAMMPS_NS;
using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using grainscope::BoxState;
using grainscope::Contact;
using grainscope::ContactObserver;
using grainscope::EnergyLedger;

namespace {

// A line of an input script would replace the books of a compute behind its back.
bool making = false;

bool one_of(const char *style, std::initializer_list<const char *> styles) {
  for (const char *one : styles)
    if (!strcmp(style, one)) return true;
  return false;
}

EnergyLedger::Grain grain(const Atom *atom, int i) { return {i, atom->rmass[i], atom->x[i], atom->v[i], atom->f[i], atom->torque[i]}; }

grainscope::LedgerFrame frame_of(LAMMPS *lmp) {
  const BoxState box(lmp);
  return {box.velocity_gradient, box.centre, box.edges.diagonal(), box.edge_velocities.diagonal()};
}

}

struct FixLedgerRecord::Impl {
  EnergyLedger ledger;
  PairGranInsitu *pair = nullptr;
  std::string name;             // of the compute, for messages
  double arrived = 0.0;         // grains on this rank at the ends of steps less those at their beginnings: over all ranks 0
  bool stepping = false;        // between the two
  double dt = 0.0;

  /** The state of all ranks together: the first one keeps it. */
  void hold(const EnergyLedger::State &state, const grainscope::LedgerFrame &frame, bool first) {
    ledger.restore(first ? state : EnergyLedger::State{}, frame);
  }
};

/** What a restart file holds: doubles throughout. */
struct FixLedgerRecord::Saved {
  double started;              // whether there was a step yet
  EnergyLedger::State state;
  grainscope::LedgerFrame frame;
};

FixLedgerRecord::FixLedgerRecord(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg), impl_(new Impl) {
  if (!making) error->all(FLERR, "fix ledger/record: is made by the computes that need it, not by an input script");
  impl_->name = arg[3];
  restart_global = 1;
}

FixLedgerRecord::~FixLedgerRecord() {}

int FixLedgerRecord::setmask() { return FixConst::PRE_INITIAL_INTEGRATE | FixConst::PRE_FINAL_INTEGRATE; }

void FixLedgerRecord::fail(const std::string &message) const {
  error->all(FLERR, (impl_->name + ": " + message).c_str());
  std::abort();  // not reached: error->all ends the run
}

/** Whether some grain belongs to the ledger's group and to another. Collective. */
bool FixLedgerRecord::shares_grains(int other_groupbit) const {
  int any = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & groupbit) && (atom->mask[i] & other_groupbit)) any = 1;
  MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, world);
  return any;
}

/** Kinetic energy is booked as velocity Verlet moves it: every grain of the group by one such fix, or not at all (frozen). */
void FixLedgerRecord::require_moved_by_verlet() const {
  int moved = 0;
  for (int k = 0; k < modify->nfix; k++) {
    const Fix *fix = modify->fix[k];
    if (one_of(fix->style, {"nve/sphere", "nve/superquadric", "nve/spheroid", "freeze"})) {
      moved |= fix->groupbit;
    } else if (fix->time_integrate || fix->rigid_flag || strstr(fix->style, "multisphere") || !strcmp(fix->style, "move")) {
      if (shares_grains(fix->groupbit))
        fail(std::string("knows grains that are moved by fix nve/sphere, nve/superquadric or nve/spheroid, or frozen, got fix ") + fix->id + " of style " +
             fix->style);
    }
  }
  int loose = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & groupbit) && !(atom->mask[i] & moved)) loose++;
  MPI_Allreduce(MPI_IN_PLACE, &loose, 1, MPI_INT, MPI_SUM, world);
  if (loose)
    fail("every grain of the group must be moved by fix nve/sphere, nve/superquadric or nve/spheroid, or be frozen, got " + std::to_string(loose) +
         " that are not");
}

void FixLedgerRecord::require_flowing_box() const {
  for (int k = 0; k < modify->nfix; k++) {
    const Fix *fix = modify->fix[k];
    if (!fix->box_change_size && !fix->box_change_shape) continue;
    const std::string which = std::string("fix ") + fix->id + " (" + fix->style + ")";
    if (!domain->deform_vremap) fail("needs a box that carries velocities along where it deforms, 'remap v', got " + which + " without");
    if (domain->deform_groupbit != 1)
      fail("needs a box that deforms for the group all, got " + which + " for the group " + group->names[fix->igroup]);
  }
}

void FixLedgerRecord::init() {
  impl_->pair = PairGranInsitu::required_by(lmp, impl_->name.c_str());
  ContactObserver &observer = impl_->pair->observer();
  const grainscope::ContactLaw &law = impl_->pair->law();
  if (!law.keeps_past())
    fail("needs 'ledger on' in pair_style gran/insitu, which remembers what each contact stored, got '" + impl_->pair->models() + "'");
  if (!law.why_no_energy().empty()) fail(law.why_no_energy());
  if (impl_->pair->renumbered())
    fail("grains were given other IDs, and what is known of contacts goes by ID: say 'compress no' to delete_atoms");
  require_moved_by_verlet();
  require_flowing_box();
  impl_->ledger.set_law(law);
  observer.add(this);
  impl_->arrived = 0.0;
  impl_->stepping = false;
  impl_->dt = update->dt;
}

void FixLedgerRecord::begin_contacts() { impl_->ledger.begin_evaluation(atom->nlocal, impl_->pair->observer().repeats()); }

void FixLedgerRecord::add_contacts(grainscope::ContactSpan contacts) {
  const bool springs_move = impl_->pair->observer().springs_move();
  for (const Contact &c : contacts)
    if (atom->mask[c.i] & atom->mask[c.j()] & groupbit) impl_->ledger.add(c, update->dt, springs_move);
}

/** Of a sphere, whose angular momentum the host does not keep. */
double FixLedgerRecord::moment_of_inertia(int i) const {
  return (domain->dimension == 2 ? 0.5 : 0.4) * atom->rmass[i] * atom->radius[i] * atom->radius[i];
}

/** Angular momentum now, and angular velocity after the kick of the coming half step. Spheroids: from the angular momentum, which the
 *  integrators keep; the host's `velocity setAngular` leaves omega at odds with it. */
void FixLedgerRecord::coming_spin(int i, double momentum[3], double omega_after[3]) const {
  const double half = 0.5 * update->dt, *torque = atom->torque[i];
  double kicked[3];
  if (!atom->superquadric_flag) {
    const double inertia = moment_of_inertia(i);
    for (int k = 0; k < 3; k++) {
      momentum[k] = inertia * atom->omega[i][k];
      omega_after[k] = atom->omega[i][k] + half / inertia * torque[k];
    }
    return;
  }
  for (int k = 0; k < 3; k++) {
    momentum[k] = atom->angmom[i][k];
    kicked[k] = momentum[k] + half * torque[k];
  }
  const double *inertia = atom->inertia[i];
  if (grainscope::is_symmetric_top(inertia)) return grainscope::angular_velocity(inertia, kicked, atom->quaternion[i], omega_after);
  const Matrix3d r = grainscope::orientation(*atom, i).toRotationMatrix();
  Map<Vector3d>(omega_after + 0) = r * (r.transpose() * Map<const Vector3d>(kicked)).cwiseQuotient(Map<const Vector3d>(inertia));
}

/** The number of grains. */
double FixLedgerRecord::start_step(EnergyLedger &ledger) const {
  double grains = 0.0;
  ledger.begin_start_of_step(frame_of(lmp));
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    double momentum[3], omega_after[3];
    coming_spin(i, momentum, omega_after);
    ledger.start_of_step(grain(atom, i), omega_after, momentum, update->dt);
    grains += 1.0;
  }
  ledger.book_start(update->dt);
  return grains;
}

void FixLedgerRecord::pre_initial_integrate() {
  if (!impl_->ledger.pending() && impl_->dt != update->dt)
    fail("the time step changed from " + grainscope::Arguments::text(impl_->dt) + " to " + grainscope::Arguments::text(update->dt) +
         " without a new set-up of the run: the forces of one belong to the half steps of the other");
  impl_->dt = update->dt;
  impl_->arrived -= start_step(impl_->ledger);
  impl_->stepping = true;
}

void FixLedgerRecord::pre_final_integrate() {
  impl_->ledger.begin_end_of_step();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    double momentum[3];
    const double *omega = atom->omega[i];
    if (!atom->superquadric_flag)
      for (int k = 0; k < 3; k++) momentum[k] = moment_of_inertia(i) * omega[k];
    impl_->ledger.end_of_step(grain(atom, i), omega, atom->superquadric_flag ? atom->angmom[i] : momentum, update->dt);
    impl_->arrived += 1.0;
  }
  impl_->ledger.book_step(update->dt);
  impl_->stepping = false;
}

grainscope::LedgerAccount FixLedgerRecord::account() const {
  using E = EnergyLedger;
  grainscope::LedgerAccount sum;
  if (!impl_->pair) fail("was not set up: do not use 'pre no' in the first run with it");
  std::unique_ptr<E> ahead;  // as the first step of the run will begin
  const bool begins = impl_->ledger.pending() && !impl_->stepping;
  if (begins) {
    ahead.reset(new E(impl_->ledger));
    start_step(*ahead);
  }
  const E &ledger = ahead ? *ahead : impl_->ledger;
  double values[2 * E::entries + 2 * E::stores + 2], *at = values;
  const auto put = [&at](const auto &numbers) { for (double one : numbers) *at++ = one; };
  put(ledger.totals());
  put(ledger.last());
  put(ledger.stored());
  put(ledger.stored_before());
  *at++ = ledger.start_energy();
  *at++ = impl_->stepping ? 0.0 : impl_->arrived;
  MPI_Allreduce(MPI_IN_PLACE, values, at - values, MPI_DOUBLE, MPI_SUM, world);
  at = values;
  const auto take = [&at](auto &numbers) { for (double &one : numbers) one = *at++; };
  take(sum.totals);
  take(sum.last);
  take(sum.stored);
  take(sum.change);
  if (at[1] != 0.0)
    fail("the group changed by " + std::to_string(static_cast<long>(at[1])) + " grains in the middle of a run: the ledger "
         "follows grains that stay. Define it after insertion; if none was inserted or deleted, grains were lost: look at the time step");
  double change = 0.0, last_change = 0.0;
  for (int k = 0; k < E::stores; k++) {
    change += sum.stored[k];
    sum.change[k] = sum.stored[k] - sum.change[k];
    last_change += sum.change[k];
  }
  if (begins) {  // there is no last step
    sum.last.fill(0.0);
    sum.change.fill(0.0);
    last_change = 0.0;
  }
  sum.residual = E::residual(sum.totals, change - *at);
  sum.last_residual = E::residual(sum.last, last_change);
  return sum;
}

std::string FixLedgerRecord::id_for(const char *compute) { return std::string(compute) + "_ledger"; }

FixLedgerRecord *FixLedgerRecord::make(LAMMPS *lmp, const char *id, int igroup, const std::string &style) {
  const std::string record = id_for(id);
  if (lmp->modify->find_fix(record.c_str()) >= 0)
    lmp->error->all(FLERR, ("compute " + std::string(id) + " needs the fix ID '" + record + "' for its ledger, but it is taken").c_str());
  const std::string words[4] = {record, lmp->group->names[igroup], "ledger/record",
                                std::string("compute ") + id + " (" + style + ")"};
  char *arg[4];
  for (int k = 0; k < 4; k++) arg[k] = const_cast<char *>(words[k].c_str());
  making = true;
  lmp->modify->add_fix(4, arg);
  making = false;
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

/** Summed over ranks, so that any number of them may continue; the first number says whether there was a step yet. */
void FixLedgerRecord::write_restart(FILE *file) {
  Saved saved;
  saved.started = impl_->ledger.started();
  saved.state = impl_->ledger.state();
  saved.frame = impl_->ledger.frame();
  MPI_Allreduce(MPI_IN_PLACE, saved.state.data(), saved.state.size(), MPI_DOUBLE, MPI_SUM, world);
  // As a continued run will: the run that goes on stays equal to it.
  if (saved.started != 0.0) impl_->hold(saved.state, saved.frame, comm->me == 0);
  if (comm->me != 0) return;
  const int size = sizeof saved;
  fwrite(&size, sizeof size, 1, file);
  fwrite(&saved, size, 1, file);
}

void FixLedgerRecord::restart(char *buffer) {
  Saved saved;
  memcpy(static_cast<void *>(&saved), buffer, sizeof saved);
  if (saved.started != 0.0) impl_->hold(saved.state, saved.frame, comm->me == 0);
}

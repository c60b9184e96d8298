// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_ledger_record.h"
#include "arguments.h"
#include "box_state.h"
#include "contact_observer.h"
#include "grain_shape.h"
#include "ledger_account.h"
#include "ledger_requirements.h"
#include "pair_gran_insitu.h"
#include "restart_state.h"
#include "spheroid_rotation.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "update.h"
#include <algorithm>
#include <memory>
#include <tuple>

using namespace LAMMPS_NS;
using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using grainscope::BoxState;
using grainscope::Contact;
using grainscope::ContactObserver;
using grainscope::EnergyLedger;

namespace {

const grainscope::ComputeFix record{"ledger/record", "_ledger", "ledger", "keeps the ledger"};

/** In restart files; sums over ranks, so that any number of them may continue. */
struct SavedLedger {
  static constexpr std::uint32_t version = 1;
  double started;  // whether there was a step yet
  double state[std::tuple_size<EnergyLedger::State>::value];
  double gradient[9], centre[3], edge_lengths[3], edge_rates[3];  // of the frame

  void set_frame(const grainscope::LedgerFrame &frame) {
    Map<Matrix3d>(gradient + 0) = frame.velocity_gradient;
    Map<Vector3d>(centre + 0) = frame.centre;
    Map<Vector3d>(edge_lengths + 0) = frame.edge_lengths;
    Map<Vector3d>(edge_rates + 0) = frame.edge_rates;
  }
  grainscope::LedgerFrame frame() const {
    return {Map<const Matrix3d>(gradient), Map<const Vector3d>(centre), Map<const Vector3d>(edge_lengths),
            Map<const Vector3d>(edge_rates)};
  }
};

EnergyLedger::Grain grain(const Atom *atom, int i) {
  return {i, atom->rmass[i], atom->x[i], atom->v[i], atom->f[i], atom->torque[i]};
}

grainscope::LedgerFrame frame_of(LAMMPS *lmp) {
  const BoxState box(lmp);
  return {box.velocity_gradient, box.centre, box.edges.diagonal(), box.edge_velocities.diagonal()};
}

}

struct FixLedgerRecord::Impl {
  EnergyLedger ledger;
  PairGranInsitu *pair = nullptr;
  std::string name;  // of the compute, for messages
  // grains on this rank at the ends of steps less those at their beginnings: over all ranks 0
  double arrived = 0.0;
  bool stepping = false;  // between the two
  double dt = 0.0;

  /** The state of all ranks together: the first one keeps it. */
  void take(const SavedLedger &saved, bool first) {
    if (saved.started == 0.0) return;
    EnergyLedger::State state{};
    if (first) std::copy(saved.state, saved.state + state.size(), state.begin());
    ledger.restore(state, saved.frame());
  }
};

FixLedgerRecord::FixLedgerRecord(LAMMPS *lmp, int narg, char **arg)
    : InternalFix(lmp, narg, arg, "the computes that need it"), impl_(new Impl) {
  impl_->name = arg[3];
  restart_global = 1;
}

FixLedgerRecord::~FixLedgerRecord() {}

int FixLedgerRecord::setmask() { return FixConst::PRE_INITIAL_INTEGRATE | FixConst::PRE_FINAL_INTEGRATE; }

void FixLedgerRecord::fail(const std::string &message) const {
  error->all(FLERR, (impl_->name + ": " + message).c_str());
  std::abort();  // not reached: error->all ends the run
}

void FixLedgerRecord::init() {
  impl_->pair = PairGranInsitu::required_by(lmp, impl_->name.c_str());
  ContactObserver &observer = impl_->pair->observer();
  const grainscope::LedgerRequirements requirements(lmp, groupbit, impl_->name);
  requirements.require_known_contacts(*impl_->pair);
  requirements.require_moved_by_verlet();
  requirements.require_flowing_box();
  impl_->ledger.set_law(impl_->pair->law());
  observer.add(this);
  impl_->arrived = 0.0;
  impl_->stepping = false;
  impl_->dt = update->dt;
}

void FixLedgerRecord::begin_contacts() {
  impl_->ledger.begin_evaluation(atom->nlocal, impl_->pair->observer().repeats());
}

void FixLedgerRecord::add_contacts(grainscope::ContactSpan contacts) {
  const bool springs_move = impl_->pair->observer().springs_move();
  for (const Contact &c : contacts)
    if (!c.with_wall() && (atom->mask[c.i] & atom->mask[c.j()] & groupbit))
      impl_->ledger.add(c, update->dt, springs_move);
}

/** Of a sphere, whose angular momentum the host does not keep. */
double FixLedgerRecord::moment_of_inertia(int i) const {
  return (domain->dimension == 2 ? 0.5 : 0.4) * atom->rmass[i] * atom->radius[i] * atom->radius[i];
}

/** Angular momentum now, and angular velocity after the kick of the coming half step. Spheroids: from the angular
 *  momentum, which the integrators keep; the host's `velocity setAngular` leaves omega at odds with it. */
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
  if (grainscope::is_symmetric_top(inertia))
    return grainscope::angular_velocity(inertia, kicked, atom->quaternion[i], omega_after);
  const Matrix3d r = grainscope::orientation(*atom, i).toRotationMatrix();
  Map<Vector3d>(omega_after + 0) =
      r * (r.transpose() * Map<const Vector3d>(kicked)).cwiseQuotient(Map<const Vector3d>(inertia));
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
    fail("the time step changed from " + grainscope::Arguments::text(impl_->dt) + " to " +
         grainscope::Arguments::text(update->dt) +
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
  const auto put = [&at](const auto &numbers) {
    for (double one : numbers) *at++ = one;
  };
  put(ledger.totals());
  put(ledger.last());
  put(ledger.stored());
  put(ledger.stored_before());
  *at++ = ledger.start_energy();
  *at++ = impl_->stepping ? 0.0 : impl_->arrived;
  MPI_Allreduce(MPI_IN_PLACE, values, at - values, MPI_DOUBLE, MPI_SUM, world);
  at = values;
  const auto take = [&at](auto &numbers) {
    for (double &one : numbers) one = *at++;
  };
  take(sum.totals);
  take(sum.last);
  take(sum.stored);
  take(sum.change);
  if (at[1] != 0.0)
    fail("the group changed by " + std::to_string(static_cast<long>(at[1])) +
         " grains in the middle of a run: the ledger "
         "follows grains that stay. Define it after insertion; if none was inserted or deleted, grains were lost: look "
         "at the time step");
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

FixLedgerRecord *FixLedgerRecord::make(LAMMPS *lmp, const char *id, int igroup, const std::string &style) {
  return static_cast<FixLedgerRecord *>(
      record.make(lmp, id, igroup, {std::string("compute ") + id + " (" + style + ")"}));
}

FixLedgerRecord *FixLedgerRecord::find(LAMMPS *lmp, const char *id) {
  return static_cast<FixLedgerRecord *>(record.find(lmp, id));
}

void FixLedgerRecord::forget(LAMMPS *lmp, const char *id) { record.remove(lmp, id); }

/** The run that goes on stays equal to one that is resumed: it, too, has the sums on the first rank. */
void FixLedgerRecord::write_restart(FILE *file) {
  SavedLedger saved;
  saved.started = impl_->ledger.started();
  const EnergyLedger::State state = impl_->ledger.state();
  std::copy(state.begin(), state.end(), saved.state);
  saved.set_frame(impl_->ledger.frame());
  MPI_Allreduce(MPI_IN_PLACE, saved.state, state.size(), MPI_DOUBLE, MPI_SUM, world);
  impl_->take(saved, comm->me == 0);
  if (comm->me == 0) grainscope::write_state(file, saved);
}

void FixLedgerRecord::restart(char *buffer) {
  impl_->take(grainscope::read_state<SavedLedger>(lmp, *this, style, buffer), comm->me == 0);
}

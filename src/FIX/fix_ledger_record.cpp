// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_ledger_record.h"
#include "arguments.h"
#include "box_state.h"
#include "contact_observer.h"
#include "grain_shape.h"
#include "ledger_account.h"
#include "ledger_grains.h"
#include "ledger_gravity.h"
#include "ledger_requirements.h"
#include "pair_gran_insitu.h"
#include "restart_state.h"
#include "spheroid_rotation.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "update.h"
#include <algorithm>
#include <cstring>
#include <initializer_list>
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
using grainscope::LedgerGrains;

namespace {

const grainscope::ComputeFix record{"ledger/record", "_ledger", "ledger", "keeps the ledger"};

/** In restart files; sums over ranks, so that any number of them may continue. */
struct SavedLedger {
  static constexpr std::uint32_t version = 2;
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

/** Makes a fix the first to see grains before they are dealt out to the ranks: others let some in or out there. */
struct FirstBeforeExchange : Modify {
  static void make(Modify *modify, const Fix *fix) {
    int *const first = modify->*(&FirstBeforeExchange::list_pre_exchange), *const end = first + modify->n_pre_exchange;
    int *const at = std::find_if(first, end, [=](int k) { return modify->fix[k] == fix; });
    if (at != end) std::rotate(first, at, at + 1);
  }
};

grainscope::LedgerFrame frame_of(LAMMPS *lmp) {
  const BoxState box(lmp);
  return {box.velocity_gradient, box.centre, box.edges.diagonal(), box.edge_velocities.diagonal()};
}

}

struct FixLedgerRecord::Impl {
  EnergyLedger ledger;
  PairGranInsitu *pair = nullptr;
  grainscope::LedgerGravity gravity;
  grainscope::LedgerRequirements::Movers movers;
  // The grains as they were before some may leave and come: in a step that builds neighbour lists, after a run.
  std::unique_ptr<LedgerGrains> before_exchange, after_run;
  bool may_pass = false;    // grains, in a step
  bool laws_known = false;  // those of walls
  std::string name;         // of the compute, for messages
  bool stepping = false;    // from the beginning of a step to its end
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

int FixLedgerRecord::setmask() {
  return FixConst::PRE_INITIAL_INTEGRATE | FixConst::PRE_EXCHANGE | FixConst::PRE_FINAL_INTEGRATE;
}

void FixLedgerRecord::fail(const std::string &message) const {
  error->all(FLERR, (impl_->name + ": " + message).c_str());
  std::abort();  // not reached: error->all ends the run
}

void FixLedgerRecord::init() {
  impl_->pair = PairGranInsitu::required_by(lmp, impl_->name.c_str());
  ContactObserver &observer = impl_->pair->observer();
  const grainscope::LedgerRequirements requirements(lmp, groupbit, impl_->name);
  requirements.require_known_contacts(*impl_->pair);
  impl_->movers = requirements.require_moved_by_verlet();
  requirements.require_flowing_box();
  impl_->laws_known = false;
  impl_->gravity = grainscope::LedgerGravity(lmp);
  impl_->may_pass = grains_may_pass();
  impl_->before_exchange.reset();
  FirstBeforeExchange::make(modify, this);
  observer.add(this);
  impl_->stepping = false;
  impl_->dt = update->dt;
}

/** Not in a periodic box where nobody else has a hand in which grains there are. */
bool FixLedgerRecord::grains_may_pass() const {
  const std::initializer_list<const char *> quiet = {"contacthistory", "contactproperty", "property",
                                                     "mesh",           "deform",          "press/strain",
                                                     "run/guard",      "setup/memory",    "ledger/record"};
  if (domain->nonperiodic) return true;
  for (int k = 0; k < modify->nfix; k++) {
    const auto begins = [style = modify->fix[k]->style](const char *one) { return !strncmp(style, one, strlen(one)); };
    if ((modify->fmask[k] & FixConst::PRE_EXCHANGE) && std::none_of(quiet.begin(), quiet.end(), begins)) return true;
  }
  return false;
}

void FixLedgerRecord::begin_contacts() {
  if (!impl_->laws_known) {
    const grainscope::LedgerRequirements requirements(lmp, groupbit, impl_->name);
    impl_->ledger.set_laws(impl_->pair->law(), requirements.require_known_walls());
    impl_->laws_known = true;
  }
  impl_->ledger.begin_evaluation(atom->nlocal, impl_->pair->observer().repeats());
}

void FixLedgerRecord::add_contacts(grainscope::ContactSpan contacts) {
  impl_->ledger.add(contacts, {atom->mask, groupbit, atom->tag}, update->dt, impl_->pair->observer().springs_move());
}

EnergyLedger::Grain FixLedgerRecord::shown(int i) const {
  static const double none[3] = {0.0, 0.0, 0.0};
  const bool held = impl_->movers.hold(atom->mask[i]);
  return {i, atom->rmass[i], atom->x[i], atom->v[i], held ? none : atom->f[i], held ? none : atom->torque[i]};
}

Vector3d FixLedgerRecord::weight(int i) const {
  const int mask = atom->mask[i];
  if (impl_->movers.hold(mask)) return Vector3d::Zero();
  return atom->rmass[i] * impl_->gravity.acceleration(mask);
}

/** Of a sphere, whose angular momentum the host does not keep. */
double FixLedgerRecord::moment_of_inertia(int i) const {
  return (domain->dimension == 2 ? 0.5 : 0.4) * atom->rmass[i] * atom->radius[i] * atom->radius[i];
}

/** Where it is kept, or made for a sphere in `place`. */
inline const double *FixLedgerRecord::momentum(int i, double place[3]) const {
  if (atom->superquadric_flag) return atom->angmom[i];
  for (int k = 0; k < 3; k++) place[k] = moment_of_inertia(i) * atom->omega[i][k];
  return place;
}

/** Angular momentum now, and angular velocity after the kick of the coming half step. Spheroids: from the angular
 *  momentum, which the integrators keep; the host's `velocity setAngular` leaves omega at odds with it. */
void FixLedgerRecord::coming_spin(const EnergyLedger::Grain &grain, double momentum[3], double omega_after[3]) const {
  const int i = grain.index;
  const double half = 0.5 * update->dt, *torque = grain.torque;
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

void FixLedgerRecord::start_step(EnergyLedger &ledger) const {
  const bool pulled = !impl_->gravity.none();
  const bool evaluated = ledger.pending();
  impl_->gravity.update();
  ledger.begin_start_of_step(frame_of(lmp));
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const EnergyLedger::Grain grain = shown(i);
    double momentum[3], omega_after[3];
    coming_spin(grain, momentum, omega_after);
    ledger.start_of_step(grain, omega_after, momentum, update->dt);
    if (pulled) ledger.start_with_weight(grain, weight(i), update->dt);
  }
  ledger.book_start(update->dt);
  if (impl_->after_run) book_passage_between_steps(ledger, evaluated);
}

/** In the middle of a step: with the velocities of the half step, before or after grains were dealt out. */
std::unique_ptr<LedgerGrains> FixLedgerRecord::grains_in_step() const {
  std::unique_ptr<LedgerGrains> grains(new LedgerGrains);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    double place[3];
    grains->add(atom->tag[i], impl_->ledger.kinetic_in_step(shown(i), atom->omega[i], momentum(i, place)));
  }
  return grains;
}

std::unique_ptr<LedgerGrains> FixLedgerRecord::grains_between_steps(const EnergyLedger &ledger) const {
  std::unique_ptr<LedgerGrains> grains(new LedgerGrains);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const EnergyLedger::Grain grain = shown(i);
    double momentum[3], omega_after[3];
    coming_spin(grain, momentum, omega_after);
    grains->add(atom->tag[i], ledger.kinetic_between_steps(grain, omega_after, momentum, update->dt));
  }
  return grains;
}

void FixLedgerRecord::pre_exchange() {
  if (!impl_->may_pass) return;
  impl_->before_exchange = grains_in_step();
  impl_->before_exchange->read_contacts(lmp, *impl_->pair, groupbit);
}

void FixLedgerRecord::book_passage_in_step() {
  const std::unique_ptr<LedgerGrains> before = std::move(impl_->before_exchange), now = grains_in_step();
  const grainscope::PassedGrains passed(*before, *now, world);
  if (passed.left.empty() && passed.came.empty()) return;
  now->read_contacts(lmp, *impl_->pair, groupbit);
  impl_->ledger.pass_in_step(before->taken_by(passed.left, true), now->taken_by(passed.came, true));
}

/** After a run there is no half step under way. */
void FixLedgerRecord::end_run() {
  if (impl_->stepping || !impl_->ledger.started()) return;
  impl_->after_run = grains_between_steps(impl_->ledger);
  impl_->after_run->read_contacts(lmp, *impl_->pair, groupbit);
}

/** `evaluated`: forces were evaluated since, so that contacts are those of the grains that there are now. With 'pre no'
 *  they are seen to be others at the end of the coming step. */
void FixLedgerRecord::book_passage_between_steps(EnergyLedger &ledger, bool evaluated) const {
  LedgerGrains &before = *impl_->after_run;
  const std::unique_ptr<LedgerGrains> now = grains_between_steps(ledger);
  const grainscope::PassedGrains passed(before, *now, world);
  if (passed.left.empty() && passed.came.empty()) return;
  now->read_contacts(lmp, *impl_->pair, groupbit);
  EnergyLedger::Passage out = before.taken_by(passed.left, !evaluated), in = now->taken_by(passed.came, !evaluated);
  if (evaluated) return ledger.pass_between_steps(out, in);
  EnergyLedger::Passage out_moving, in_moving;
  std::swap(out_moving.kinetic, out.kinetic);
  std::swap(in_moving.kinetic, in.kinetic);
  ledger.pass_between_steps(out_moving, in_moving);
  ledger.pass_in_step(out, in);
}

/** Writing a restart file deals grains out to the ranks, where those beyond an open face are lost: a run that reads the
 *  file knows nothing of them. */
void FixLedgerRecord::book_leaving_before_run() {
  if (!impl_->after_run) return;
  const std::unique_ptr<LedgerGrains> now = grains_between_steps(impl_->ledger);
  const std::vector<int> left = grainscope::PassedGrains(*impl_->after_run, *now, world).left;
  impl_->ledger.pass_between_steps(impl_->after_run->taken_by(left, false), EnergyLedger::Passage());
  impl_->after_run->forget(left);
}

void FixLedgerRecord::pre_initial_integrate() {
  if (!impl_->ledger.pending() && impl_->dt != update->dt)
    fail("the time step changed from " + grainscope::Arguments::text(impl_->dt) + " to " +
         grainscope::Arguments::text(update->dt) +
         " without a new set-up of the run: the forces of one belong to the half steps of the other");
  impl_->dt = update->dt;
  start_step(impl_->ledger);
  impl_->after_run.reset();
  impl_->stepping = true;
}

void FixLedgerRecord::pre_final_integrate() {
  const bool pulled = !impl_->gravity.none();
  impl_->gravity.update();
  if (impl_->before_exchange) book_passage_in_step();
  impl_->ledger.begin_end_of_step();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const EnergyLedger::Grain grain = shown(i);
    double place[3];
    impl_->ledger.end_of_step(grain, atom->omega[i], momentum(i, place), update->dt);
    if (pulled) impl_->ledger.end_with_weight(grain, weight(i));
  }
  impl_->ledger.book_step(update->dt);
  impl_->stepping = false;
}

grainscope::LedgerAccount FixLedgerRecord::account() const {
  using E = EnergyLedger;
  grainscope::LedgerAccount sum;
  if (!impl_->pair) fail("was not set up: do not use 'pre no' in the first run with it");
  impl_->pair->observer().require_complete(impl_->name);
  std::unique_ptr<E> ahead;  // as the first step of the run will begin
  const bool begins = impl_->ledger.pending() && !impl_->stepping;
  if (begins) {
    ahead.reset(new E(impl_->ledger));
    start_step(*ahead);
  }
  const E &ledger = ahead ? *ahead : impl_->ledger;
  double values[2 * E::entries + 2 * E::stores + 1], *at = values;
  const auto put = [&at](const auto &numbers) {
    for (double one : numbers) *at++ = one;
  };
  put(ledger.totals());
  put(ledger.last());
  put(ledger.stored());
  put(ledger.stored_before());
  *at++ = ledger.start_energy();
  MPI_Allreduce(MPI_IN_PLACE, values, at - values, MPI_DOUBLE, MPI_SUM, world);
  at = values;
  const auto take = [&at](auto &numbers) {
    for (double &one : numbers) one = *at++;
  };
  take(sum.totals);
  take(sum.last);
  take(sum.stored);
  take(sum.change);
  for (int k = 0; k < E::stores; k++) sum.change[k] = sum.stored[k] - sum.change[k];
  const double change = E::energy(sum.stored);
  double last_change = E::energy(sum.change);
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
  book_leaving_before_run();
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

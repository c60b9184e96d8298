// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_ledger_record.h"
#include "arguments.h"
#include "contact_observer.h"
#include "ledger_account.h"
#include "ledger_grains.h"
#include "ledger_motion.h"
#include "ledger_requirements.h"
#include "pair_gran_insitu.h"
#include "restart_state.h"
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
using grainscope::ContactObserver;
using grainscope::EnergyLedger;
using grainscope::LedgerGrains;

namespace {

const grainscope::ComputeFix record{"ledger/record", "_ledger", "ledger", "keeps the ledger"};

/** In restart files; sums over ranks, so that any number of them may continue. */
struct SavedLedger {
  static constexpr std::uint32_t version = 3;
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

/** Makes a fix the first to see grains before they are sent to their ranks: other fixes add or remove some then. */
struct FirstBeforeExchange : Modify {
  static void make(Modify *modify, const Fix *fix) {
    int *const first = modify->*(&FirstBeforeExchange::list_pre_exchange), *const end = first + modify->n_pre_exchange;
    int *const at = std::find_if(first, end, [=](int k) { return modify->fix[k] == fix; });
    if (at != end) std::rotate(first, at, at + 1);
  }
};

}

struct FixLedgerRecord::Impl {
  EnergyLedger ledger;
  PairGranInsitu *pair = nullptr;
  std::unique_ptr<grainscope::LedgerMotion> motion;  // of the run that was set up last
  // The grains before some may leave and come: in a step that builds neighbour lists, and after a run.
  std::unique_ptr<LedgerGrains> before_exchange, after_run;
  bool may_pass = false;    // grains, in a step
  bool laws_known = false;  // those of walls
  std::string name;         // of the compute, for messages
  bool stepping = false;    // from the beginning of a step to its end
  double dt = 0.0;

  void start_step(EnergyLedger &booked, LAMMPS *lmp, int groupbit);
  void book_passage_in_step(LAMMPS *lmp, int groupbit);
  void book_passage_between_steps(EnergyLedger &booked, bool evaluated, LAMMPS *lmp, int groupbit);
  void book_leaving_before_run(MPI_Comm world);

  /** The state of all ranks together: the first one keeps it. */
  void take(const SavedLedger &saved, bool first) {
    if (saved.started == 0.0) return;
    EnergyLedger::State state{};
    if (first) std::copy(saved.state, saved.state + state.size(), state.begin());
    ledger.restore(state, saved.frame());
  }
};

void FixLedgerRecord::Impl::book_passage_in_step(LAMMPS *lmp, int groupbit) {
  const std::unique_ptr<LedgerGrains> before = std::move(before_exchange), now = motion->grains_in_step(ledger);
  const grainscope::PassedGrains passed(*before, *now, lmp->world);
  if (passed.left.empty() && passed.came.empty()) return;
  now->read_contacts(lmp, *pair, groupbit);
  ledger.pass_in_step(before->taken_by(passed.left, true), now->taken_by(passed.came, true));
}

/** `evaluated`: forces were evaluated since, so that contacts are those of the grains that exist now. With 'pre no' the
 *  change is found at the end of the next step. */
void FixLedgerRecord::Impl::book_passage_between_steps(EnergyLedger &booked, bool evaluated, LAMMPS *lmp,
                                                       int groupbit) {
  LedgerGrains &before = *after_run;
  const std::unique_ptr<LedgerGrains> now = motion->grains_between_steps(booked);
  const grainscope::PassedGrains passed(before, *now, lmp->world);
  if (passed.left.empty() && passed.came.empty()) return;
  now->read_contacts(lmp, *pair, groupbit);
  EnergyLedger::Passage out = before.taken_by(passed.left, !evaluated), in = now->taken_by(passed.came, !evaluated);
  if (evaluated) return booked.pass_between_steps(out, in);
  EnergyLedger::Passage out_moving, in_moving;
  std::swap(out_moving.kinetic, out.kinetic);
  std::swap(in_moving.kinetic, in.kinetic);
  booked.pass_between_steps(out_moving, in_moving);
  booked.pass_in_step(out, in);
}

/** To write a restart file LIGGGHTS sends grains to their ranks, and those beyond an open face are lost. A run that
 *  reads the file does not know of them. */
void FixLedgerRecord::Impl::book_leaving_before_run(MPI_Comm world) {
  if (!after_run) return;
  const std::unique_ptr<LedgerGrains> now = motion->grains_between_steps(ledger);
  const std::vector<int> left = grainscope::PassedGrains(*after_run, *now, world).left;
  ledger.pass_between_steps(after_run->taken_by(left, false), EnergyLedger::Passage());
  after_run->forget(left);
}

void FixLedgerRecord::Impl::start_step(EnergyLedger &booked, LAMMPS *lmp, int groupbit) {
  const bool evaluated = booked.pending();
  motion->start_step(booked);
  if (after_run) book_passage_between_steps(booked, evaluated, lmp, groupbit);
}

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
  impl_->motion.reset(new grainscope::LedgerMotion(lmp, groupbit, requirements.require_moved_by_verlet()));
  requirements.require_flowing_box();
  impl_->laws_known = false;
  impl_->may_pass = grains_may_pass();
  impl_->before_exchange.reset();
  FirstBeforeExchange::make(modify, this);
  observer.add(this);
  impl_->stepping = false;
  impl_->dt = update->dt;
}

/** False in a periodic box where no other fix adds or removes grains. */
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

void FixLedgerRecord::add_lanes(const grainscope::ContactLanes &contacts) {
  impl_->ledger.add(contacts, {atom->mask, groupbit, atom->tag});
}

void FixLedgerRecord::end_contacts() { impl_->ledger.end_evaluation(); }

void FixLedgerRecord::pre_exchange() {
  if (!impl_->may_pass) return;
  impl_->before_exchange = impl_->motion->grains_in_step(impl_->ledger);
  impl_->before_exchange->read_contacts(lmp, *impl_->pair, groupbit);
}

/** After a run there is no half step under way. */
void FixLedgerRecord::end_run() {
  if (impl_->stepping || !impl_->ledger.started()) return;
  impl_->after_run = impl_->motion->grains_between_steps(impl_->ledger);
  impl_->after_run->read_contacts(lmp, *impl_->pair, groupbit);
}

void FixLedgerRecord::pre_initial_integrate() {
  impl_->pair->observer().require_walls();
  if (!impl_->ledger.pending() && impl_->dt != update->dt)
    fail("the time step changed from " + grainscope::Arguments::text(impl_->dt) + " to " +
         grainscope::Arguments::text(update->dt) +
         " without a new set-up of the run, in a run or before 'pre no': the two half steps of one force would differ");
  impl_->dt = update->dt;
  impl_->start_step(impl_->ledger, lmp, groupbit);
  impl_->after_run.reset();
  impl_->stepping = true;
}

void FixLedgerRecord::pre_final_integrate() {
  if (impl_->before_exchange) impl_->book_passage_in_step(lmp, groupbit);
  impl_->motion->end_step(impl_->ledger);
  impl_->stepping = false;
}

grainscope::LedgerAccount FixLedgerRecord::account() const {
  if (!impl_->pair) fail("was not set up: do not use 'pre no' in the first run with it");
  impl_->pair->observer().require_complete(impl_->name);
  std::unique_ptr<EnergyLedger> ahead;  // as the first step of the run will begin
  const bool begins = impl_->ledger.pending() && !impl_->stepping;
  if (begins) {
    ahead.reset(new EnergyLedger(impl_->ledger));
    impl_->start_step(*ahead, lmp, groupbit);
  }
  return grainscope::LedgerAccount::of(ahead ? *ahead : impl_->ledger, begins, world);
}

FixLedgerRecord *FixLedgerRecord::make(LAMMPS *lmp, const char *id, int igroup, const std::string &style) {
  return static_cast<FixLedgerRecord *>(
      record.make(lmp, id, igroup, {std::string("compute ") + id + " (" + style + ")"}));
}

FixLedgerRecord *FixLedgerRecord::find(LAMMPS *lmp, const char *id) {
  return static_cast<FixLedgerRecord *>(record.find(lmp, id));
}

void FixLedgerRecord::forget(LAMMPS *lmp, const char *id) { record.remove(lmp, id); }

/** A run that continues stays equal to one that is resumed: its sums are on the first rank too. */
void FixLedgerRecord::write_restart(FILE *file) {
  SavedLedger saved;
  impl_->book_leaving_before_run(world);
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

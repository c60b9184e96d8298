// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_setup_memory.h"
#include "arguments.h"
#include "bodies.h"
#include "grain_order.h"
#include "last_evaluation.h"
#include "last_run.h"
#include "restart_numbers.h"
#include "restart_state.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "update.h"
#include <algorithm>

using namespace LAMMPS_NS;
using grainscope::GrainMemory;

/** Handed over when the fix is moved behind all others. */
struct FixSetupMemory::Memory {
  explicit Memory(LAMMPS *lmp) : evaluation(lmp) {}
  grainscope::LastEvaluation evaluation;
  grainscope::LastRun run;
};

struct FixSetupMemory::Impl {
  explicit Impl(LAMMPS *lmp) : memory(std::make_shared<Memory>(lmp)), order(lmp) {}
  std::shared_ptr<Memory> memory;
  grainscope::GrainOrder order;
  bool running = false;
};

namespace {

/** In restart files, with a RememberedGrain of each grain; one version for both. */
struct SavedSetup {
  static constexpr std::uint32_t version = 1;
  grainscope::HostBox evaluated;
  grainscope::LastRun run;
  double stamp;
};

}

FixSetupMemory::FixSetupMemory(LAMMPS *lmp, int narg, char **arg)
    : InternalFix(lmp, narg, arg, "pair_style gran/insitu"), impl_(new Impl(lmp)) {
  restart_global = restart_peratom = create_attribute = force_reneighbor = 1;
  just_created = 0;  // the host would clear what a restart file or the fix in another place held
  next_reneighbor = -1;
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
}

FixSetupMemory::~FixSetupMemory() {
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
}

std::weak_ptr<grainscope::EvaluationMemory> FixSetupMemory::evaluation() {
  return std::shared_ptr<grainscope::EvaluationMemory>(impl_->memory, &impl_->memory->evaluation);
}

std::shared_ptr<void> FixSetupMemory::state() { return impl_->memory; }

void FixSetupMemory::take_state(const std::shared_ptr<void> &state) {
  impl_->memory = std::static_pointer_cast<Memory>(state);
}

int FixSetupMemory::setmask() { return FixConst::PRE_EXCHANGE | FixConst::PRE_FORCE; }

void FixSetupMemory::init() {
  grainscope::require_no_bodies(lmp, grainscope::Arguments(lmp, "pair_style gran/insitu setup neutral"),
                                "their forces would be summed twice when a run begins: use 'setup host'");
  impl_->running = false;
  impl_->memory->evaluation.give_up_repetition();
  next_reneighbor = -1;
  impl_->order.allow_sorting();
}

/** A run that continues would not sort grains now. */
void FixSetupMemory::setup_pre_exchange() {
  if (!impl_->memory->run.there_was_none()) impl_->order.prevent_sorting();
}

void FixSetupMemory::setup_pre_force(int) {
  Memory &memory = *impl_->memory;
  impl_->order.allow_sorting();
  if (!memory.run.goes_on(lmp, memory.evaluation.grains)) return pre_force(0);
  atom->nextsort = update->ntimestep + static_cast<bigint>(memory.run.steps_to_sorting);
  memory.evaluation.begin_repetition();
  next_reneighbor = update->ntimestep + 1;
}

void FixSetupMemory::setup(int) { impl_->memory->evaluation.end_repetition(); }

/** In the step after a restart file: LIGGGHTS does the same next, but in an order that depends on the history of the
 *  ranks. */
void FixSetupMemory::pre_exchange() {
  if (update->ntimestep != next_reneighbor) return;
  if (domain->triclinic) domain->x2lamda(atom->nlocal);
  domain->pbc();
  domain->reset_box();
  comm->setup();
  comm->exchange();
  impl_->order.sort_by_id();
  if (domain->triclinic) domain->lamda2x(atom->nlocal);
}

void FixSetupMemory::pre_force(int) {
  impl_->running = update->setupflag == 0;
  impl_->memory->evaluation.note();
}

void FixSetupMemory::post_run() {
  impl_->memory->run = grainscope::LastRun::ending_now(lmp);
  impl_->memory->evaluation.grains.note_end_of_step();
  impl_->running = false;
}

double FixSetupMemory::memory_usage() { return impl_->memory->evaluation.grains.bytes(); }
void FixSetupMemory::grow_arrays(int nmax) { impl_->memory->evaluation.grains.resize(nmax); }
void FixSetupMemory::copy_arrays(int from, int to, int) { impl_->memory->evaluation.grains.copy(from, to); }
void FixSetupMemory::set_arrays(int i) { impl_->memory->evaluation.grains.clear(i); }
int FixSetupMemory::size_restart(int) { return GrainMemory::width + 1; }
int FixSetupMemory::maxsize_restart() { return GrainMemory::width + 1; }

int FixSetupMemory::pack_exchange(int i, double *buffer) {
  impl_->memory->evaluation.grains.write(i, buffer);
  return GrainMemory::width;
}

int FixSetupMemory::unpack_exchange(int i, double *buffer) {
  impl_->memory->evaluation.grains.read(i, buffer);
  return GrainMemory::width;
}

int FixSetupMemory::pack_restart(int i, double *buffer) {
  buffer[0] = GrainMemory::width + 1;
  impl_->memory->evaluation.grains.write(i, buffer + 1);
  return GrainMemory::width + 1;
}

void FixSetupMemory::unpack_restart(int i, int nth) {
  const double *numbers = grainscope::restart_numbers(atom, i, nth, GrainMemory::width);
  if (!numbers)
    error->one(FLERR, "pair_style gran/insitu: the restart file holds the memory of 'setup neutral' in another form: "
                      "use 'setup host'");
  impl_->memory->evaluation.grains.read(i, numbers);
}

/** Called before the grains are written. The run that begins from the file wraps grains and builds lists at the same
 *  point as this one. */
void FixSetupMemory::write_restart(FILE *file) {
  Memory &memory = *impl_->memory;
  if (impl_->running) {
    memory.evaluation.wrap_grains();
    memory.run = grainscope::LastRun::ending_now(lmp);
    memory.evaluation.grains.note_end_of_step();
    next_reneighbor = update->ntimestep + 1;
  }
  if (comm->me != 0) return;
  SavedSetup saved;
  saved.evaluated = memory.evaluation.box();
  saved.run = memory.run;
  saved.stamp = memory.evaluation.stamp();
  grainscope::write_state(file, saved);
}

void FixSetupMemory::restart(char *buffer) {
  const SavedSetup saved = grainscope::read_state<SavedSetup>(lmp, *this, style, buffer);
  impl_->memory->evaluation.set_box(saved.evaluated);
  impl_->memory->run = saved.run;
  impl_->memory->evaluation.set_stamp(saved.stamp);
}

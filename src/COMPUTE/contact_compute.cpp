// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_compute.h"
#include "arguments.h"
#include "contact_law.h"
#include "contact_observer.h"
#include "fix_wall_gran_insitu.h"
#include "pair_gran_insitu.h"
#include "require_finite.h"
#include "atom.h"
#include "error.h"
#include "update.h"
#include <algorithm>

namespace grainscope {

using LAMMPS_NS::PairGranInsitu;

ContactCompute::ContactCompute(LAMMPS_NS::LAMMPS *lmp, int &iarg, int narg, char **arg, unsigned keywords, Walls walls)
    : Compute(lmp, iarg, narg, arg), observer_(nullptr), name_(std::string("compute ") + style),
      scope_(lmp, name_, keywords), tallied_(-1), unasked_(false) {
  scope_.choose_walls(walls);
  timeflag = 1;
}

void ContactCompute::init() {
  observer_ = &PairGranInsitu::required_by(lmp, name_.c_str())->observer();
  observer_->add(this);
  scope_.init();
  bodies_.reset(uses_bodies() ? new Bodies(lmp, name_) : nullptr);
  tallied_ = -1;
}

bool ContactCompute::wants_contacts() {
  // Values of single grains are not kept after a run: commands may renumber, add and remove grains.
  const bool at_end = update->ntimestep == update->laststep && (!peratom_flag || update_on_run_end());
  if (!matchstep(update->ntimestep) && !at_end) return false;
  tallied_ = update->ntimestep;
  run_over_ = false;
  return true;
}

void ContactCompute::begin_contacts() {
  scope_.update(observer_->box());
  if (bodies_) bodies_->update(observer_->box(), groupbit);
  for (Accumulator *one : sums_) one->reset();
}

void ContactCompute::add_contacts(ContactSpan contacts) {
  for (Accumulator *one : sums_) one->add(contacts, *this);
}

bool ContactCompute::takes_lanes() const {
  constexpr int all = 1;
  if (sums_.empty() || groupbit != all || selection().narrow || scope_.chosen_walls() == Walls::only) return false;
  if (bodies_ && bodies_->any()) return false;
  return std::all_of(sums_.begin(), sums_.end(), [](const Accumulator *one) { return one->takes_lanes(); });
}

void ContactCompute::add_lanes(const ContactLanes &contacts) {
  for (Accumulator *one : sums_) one->add(contacts);
}

bool ContactCompute::lanes_need_motion() const {
  return std::any_of(sums_.begin(), sums_.end(), [](const Accumulator *one) { return one->lanes_need_motion(); });
}

/** A result that was kept when the run ended stays: later motions of grains do not belong to the contacts. */
void ContactCompute::answer_once(LAMMPS_NS::bigint &answered) {
  require_tally();
  if (kept_since_run(answered)) return;
  answered = update->ntimestep;
  answer();
}

void ContactCompute::compute_vector() { answer_once(invoked_vector); }

void ContactCompute::compute_array() { answer_once(invoked_array); }

double ContactCompute::compute_scalar() {
  invoked_scalar = update->ntimestep;
  if (invoked_vector != update->ntimestep) compute_vector();
  return scalar;
}

void ContactCompute::end_run() {
  const LAMMPS_NS::bigint now = update->ntimestep;
  if (peratom_flag) {  // who asks for grains after the run must ask the compute, which knows whether they are the same
    invoked_flag &= ~(INVOKED_PERATOM);
    invoked_peratom = -1;
  }
  if (tallied_ != now || !answers_after_run()) return;
  run_over_ = true;
  unasked_ = true;
  if (vector_flag && invoked_vector != now) compute_vector();
  if (scalar_flag && invoked_scalar != now) compute_scalar();
  if (array_flag && invoked_array != now) compute_array();
  if (local_flag && invoked_local != now) compute_local();
  unasked_ = false;
}

bool ContactCompute::kept_since_run(LAMMPS_NS::bigint answered) const {
  return run_over_ && answered == update->ntimestep;
}

void ContactCompute::answer() { error->all(FLERR, (name_ + ": declares numbers that nothing computes").c_str()); }

bool ContactCompute::in_group(int i) const { return atom->mask[i] & groupbit; }

TypePairs ContactCompute::type_pairs() const {
  if (atom->ntypes < 1)
    Arguments(lmp, name_)
        .fail("'rows types' needs the number of atom types: define the compute after the simulation box");
  return TypePairs(atom->ntypes);
}

ContactCompute::Selection ContactCompute::selection() const {
  const TypePair &types = scope_.type_pair();
  const RegionSolid *const region = scope_.within();
  return {atom->mask, groupbit, scope_.chosen_walls(), region || !types.any(), types, region};
}

const ContactLaw &ContactCompute::law() const { return PairGranInsitu::required_by(lmp, name_.c_str())->law(); }

void ContactCompute::require_known_losses() const {
  const std::string why = scope_.chosen_walls() == Walls::only ? "" : law().why_no_losses();
  if (!why.empty()) Arguments(lmp, name_).fail(why);
  if (scope_.chosen_walls() == Walls::no) return;
  for (const Wall &wall : walls_of(lmp)) {
    const std::string of_wall = wall.law ? wall.law->why_no_losses() : "";
    if (!of_wall.empty())
      Arguments(lmp, name_).fail("wall '" + wall.name + "': " + of_wall + ": change its models, or use 'walls no'");
  }
}

std::vector<const ContactLaw *> ContactCompute::laws_of_contacts() const {
  std::vector<const ContactLaw *> laws;
  if (scope_.chosen_walls() != Walls::only) laws.push_back(&law());
  if (scope_.chosen_walls() == Walls::no) return laws;
  for (const Wall &wall : walls_of(lmp))
    if (wall.law) laws.push_back(wall.law);
  return laws;
}

void ContactCompute::require_tally() const {
  if (attached() && scope_.chosen_walls() != Walls::no) observer_->require_complete(name_ + " " + id);
  if (attached() && tallied_ == update->ntimestep) return;
  const std::string message =
      name_ + " " + id +
      ": not evaluated on this step, because nothing requested it in advance: use it in thermo, fix ave/time, a dump "
      "or a variable of one of them, or after the last step of a run";
  error->all(FLERR, message.c_str());
}

void ContactCompute::require_finite(double contacts) const {
  grainscope::require_finite(lmp, name_ + " " + id, contacts, "the place or direction",
                             "contacts is not finite: check what moves or pushes these grains");
}

void ContactCompute::sum_over_ranks(double *values, int n) const {
  MPI_Allreduce(MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_SUM, world);
}

}

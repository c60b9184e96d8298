// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_dissipation.h"
#include "arguments.h"
#include "contact_measures.h"
#include "contact_observer.h"
#include "fix_ledger_record.h"
#include "ledger_account.h"
#include "grain_power.h"
#include "requirements.h"
#include "atom.h"
#include "domain.h"
#include "update.h"

using namespace LAMMPS_NS;
using Eigen::Map;
using Eigen::Vector3d;
using grainscope::Contact;

struct ComputeDissipation::Impl {
  enum class Mode { instantaneous, step, ledger } mode = Mode::step;
  double normal = 0.0, friction = 0.0, tangential_damping = 0.0, contacts = 0.0, sliding = 0.0;
  grainscope::GrainPower normal_damping_forces, tangential_damping_forces;
};

ComputeDissipation::ComputeDissipation(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : ContactCompute(lmp, iarg, narg, arg), impl_(new Impl) {
  grainscope::Arguments arguments(lmp, name_, iarg, narg, arg);
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword({"mode"});
    const std::string mode = arguments.choice(keyword, {"instantaneous", "step", "ledger"});
    impl_->mode = mode == "step" ? Impl::Mode::step : mode == "ledger" ? Impl::Mode::ledger : Impl::Mode::instantaneous;
  }
  if (impl_->mode == Impl::Mode::ledger) grainscope::require_box(lmp, arguments);
  scalar_flag = vector_flag = 1;
  extscalar = 1;
  extvector = 1;
  size_vector = 5;
  vector = new double[size_vector]();
  if (impl_->mode == Impl::Mode::ledger) FixLedgerRecord::make(lmp, id, igroup, "dissipation mode ledger");
}

ComputeDissipation::~ComputeDissipation() {
  if (impl_->mode == Impl::Mode::ledger) FixLedgerRecord::forget(lmp, id);
  delete[] vector;
}

void ComputeDissipation::init() {
  ContactCompute::init();
  require_known_losses();
  if (impl_->mode == Impl::Mode::ledger) FixLedgerRecord::find(lmp, id);
}

/** A ledger that does not close, as grains came, is no matter of a run that does not ask for it. */
bool ComputeDissipation::answers_after_run() const { return impl_->mode != Impl::Mode::ledger; }

bool ComputeDissipation::needs_images() const { return impl_->mode == Impl::Mode::step; }

void ComputeDissipation::begin_contacts() {
  impl_->normal = impl_->friction = impl_->tangential_damping = impl_->contacts = impl_->sliding = 0.0;
  if (impl_->mode != Impl::Mode::step) return;
  impl_->normal_damping_forces.reset(atom->nlocal);
  impl_->tangential_damping_forces.reset(atom->nlocal);
}

void ComputeDissipation::add_contact(const Contact &c) {
  if (!both_in_group(c.i, c.j)) return;
  Impl &sums = *impl_;
  sums.contacts += c.weight;
  if (c.sliding) sums.sliding += c.weight;
  if (sums.mode == Impl::Mode::ledger) return;
  if (sums.mode == Impl::Mode::instantaneous) {
    sums.normal += c.weight * grainscope::damping_loss(c);
    sums.friction += c.weight * grainscope::friction_loss(c);
    if (c.damped) sums.tangential_damping += c.weight * c.tangential_damping * c.tangential_velocity.squaredNorm();
    return;
  }
  if (c.sliding) sums.friction += c.weight * c.friction_force.norm() * c.slip;  // over dt, later
  const Vector3d lever_i = c.point - Map<const Vector3d>(atom->x[c.i]);
  const Vector3d lever_j = lever_i + c.branch;
  Vector3d image_velocity = Vector3d::Zero();
  if (c.ghost && domain->deform_vremap && (atom->mask[c.j] & domain->deform_groupbit))
    image_velocity = observer_->image_velocity(c.j);
  sums.normal_damping_forces.add(c, c.normal_damping * c.normal, lever_i, lever_j, image_velocity);
  if (c.damped)
    sums.tangential_damping_forces.add(c, -c.tangential_damping * c.tangential_velocity, lever_i, lever_j, image_velocity);
}

void ComputeDissipation::compute_vector() {
  require_tally();
  if (kept_since_run(invoked_vector)) return;
  invoked_vector = update->ntimestep;
  const Impl &sums = *impl_;
  double normal = sums.normal, friction = sums.friction, tangential_damping = sums.tangential_damping;
  if (sums.mode == Impl::Mode::step) {
    normal = -sums.normal_damping_forces.power(atom->v, atom->omega);
    friction /= observer_->time_step();
    tangential_damping = -sums.tangential_damping_forces.power(atom->v, atom->omega);
  }
  if (sums.mode == Impl::Mode::ledger) return tell_ledger();
  const double values[5] = {normal, friction, tangential_damping, sums.contacts, sums.sliding};
  std::copy(values, values + 5, vector);
  sum_over_ranks(vector, 5);
  for (int k = 0; k < 5; k++) vector[k] += 0.0;  // no negative zeros
  scalar = vector[0] + vector[1] + vector[2];
}

void ComputeDissipation::tell_ledger() {
  using E = grainscope::EnergyLedger;
  const auto last = FixLedgerRecord::find(lmp, id)->account().last;
  const E::Entry losses[3] = {E::D_n, E::D_t, E::D_damp};
  for (int k = 0; k < 3; k++) vector[k] = last[losses[k]] / update->dt;
  vector[3] = impl_->contacts;
  vector[4] = impl_->sliding;
  sum_over_ranks(vector + 3, 2);
  scalar = vector[0] + vector[1] + vector[2];
}

double ComputeDissipation::compute_scalar() {
  invoked_scalar = update->ntimestep;
  if (invoked_vector != update->ntimestep) compute_vector();
  return scalar;
}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_dissipation.h"
#include "arguments.h"
#include "contact_observer.h"
#include "contact_sums.h"
#include "fix_ledger_record.h"
#include "ledger_account.h"
#include "grain_power.h"
#include "loss_lanes.h"
#include "requirements.h"
#include "atom.h"
#include "domain.h"
#include "update.h"

using namespace LAMMPS_NS;
using Eigen::Map;
using Eigen::Vector3d;
using grainscope::Contact;
using grainscope::LossSums;

namespace {

enum class Mode { instantaneous, step, ledger };

using grainscope::Extent;
constexpr auto extensive = Extent::extensive;

grainscope::Outputs declared(const grainscope::TypePairs *pairs) {
  grainscope::Outputs outputs;
  outputs.scalar = {{"P_total", "energy/time", extensive, "all six powers together"}};
  outputs.vector = {
      {"P_n", "energy/time", extensive, "power lost by normal damping"},
      {"P_t", "energy/time", extensive, "power lost by friction of sliding contacts"},
      {"P_t_damp", "energy/time", extensive, "power lost by tangential damping of contacts that do not slide"},
      {"N_c", "-", extensive, "contacts between grains"},
      {"N_sliding", "-", extensive, "sliding contacts between grains"},
      {"P_n_w", "energy/time", extensive, "power lost by normal damping at walls"},
      {"P_t_w", "energy/time", extensive, "power lost by friction at walls"},
      {"P_t_damp_w", "energy/time", extensive, "power lost by tangential damping at walls"},
      {"N_w", "-", extensive, "contacts with walls"},
      {"N_sliding_w", "-", extensive, "sliding contacts with walls"}};
  if (!pairs) return outputs;
  grainscope::OutputList columns = {{"pair_a", "-", Extent::intensive, "atom type"},
                                    {"pair_b", "-", Extent::intensive, "atom type, a wall's too, >= pair_a"}};
  for (const grainscope::NamedOutput &one : outputs.vector)
    columns.add({"pair_" + one.name, one.unit, one.extent, one.meaning});
  outputs.set_array(pairs->size(), "pair of atom types", columns);
  return outputs;
}

/** The damping forces on each grain, to be paired with its velocities at the end of the step. */
struct DampingForces : grainscope::ContactCompute::Accumulator {
  const Atom *atom = nullptr;
  const Domain *domain = nullptr;
  const grainscope::ContactObserver *observer = nullptr;
  struct Of {
    grainscope::GrainPower normal, tangential;
  } grains, walls;

  void reset() override {
    for (Of *of : {&grains, &walls}) {
      of->normal.reset(atom->nlocal);
      of->tangential.reset(atom->nlocal);
    }
  }
  void add(grainscope::ContactSpan contacts, const grainscope::ContactCompute &of) override {
    grainscope::for_each_contact(contacts, of.selection(), [this](const Contact &c) { add(c); });
  }
  bool takes_lanes() const override { return true; }
  void add(const grainscope::ContactLanes &c) override {
    const int deformed = domain->deform_vremap ? domain->deform_groupbit : 0;
    const grainscope::GrainPower::Images images{observer->box().edge_velocities, observer->image_shift(0), atom->mask,
                                                deformed};
    grainscope::GrainPower::add_damping(c, images, grains.normal, grains.tangential);
  }
  void add(const Contact &c) {
    const grainscope::ContactMotion &m = *c.motion;
    const Vector3d lever_i = m.point - Map<const Vector3d>(atom->x[c.i]), lever_j = lever_i + c.branch;
    Vector3d image_velocity = Vector3d::Zero();
    if (c.with_wall()) image_velocity = c.wall().velocity;
    if (c.ghost() && domain->deform_vremap && (atom->mask[c.j()] & domain->deform_groupbit))
      image_velocity = observer->image_velocity(c.j());
    Of &of = c.with_wall() ? walls : grains;
    of.normal.add(c, m.normal_damping * c.normal, lever_i, lever_j, image_velocity);
    if (m.damped) of.tangential.add(c, -m.tangential_damping * m.tangential_velocity, lever_i, lever_j, image_velocity);
  }
  /** Converts sums of this rank to powers, if the friction is an energy. */
  void to_powers(LossSums &sums) const {
    for (auto one : {std::make_pair(&grains, sums.of_grains()), std::make_pair(&walls, sums.of_walls())}) {
      one.second[LossSums::normal_damping] = -one.first->normal.power(atom->v[0], atom->omega[0]);
      one.second[LossSums::friction] /= observer->time_step();
      one.second[LossSums::tangential_damping] = -one.first->tangential.power(atom->v[0], atom->omega[0]);
    }
  }
};

/** The losses of each pair of atom types. */
struct LossesOfTypes : grainscope::ContactCompute::Accumulator {
  struct Row {
    LossSums sums;
    DampingForces damping;
  };
  LossesOfTypes(grainscope::TypePairs pairs, LossSums::Of of) : pairs(pairs), rows(pairs.size()) {
    for (Row &row : rows) row.sums.of = of;
  }
  bool by_steps() const { return rows[0].sums.of == LossSums::Of::slip; }
  void reset() override {
    for (Row &row : rows) {
      row.sums.reset();
      if (by_steps()) row.damping.reset();
    }
  }
  void add(grainscope::ContactSpan contacts, const grainscope::ContactCompute &of) override {
    grainscope::for_each_contact(contacts, of.selection(), [this](const Contact &c) {
      Row &row = rows[pairs.index(c.type_i, c.type_j)];
      row.sums.add(c);
      if (by_steps()) row.damping.add(c);
    });
  }

  grainscope::TypePairs pairs;
  std::vector<Row> rows;
};

}

struct ComputeDissipation::Impl {
  Mode mode = Mode::step;
  grainscope::ContactSums<LossSums, grainscope::WholeContacts, grainscope::LossLanes> sums;
  DampingForces damping;
  std::unique_ptr<LossesOfTypes> of_types;  // of 'rows types'
};

ComputeDissipation::ComputeDissipation(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : ContactCompute(lmp, iarg, narg, arg,
                     grainscope::Scope::region | grainscope::Scope::types | grainscope::Scope::rows |
                         grainscope::Scope::walls),
      impl_(new Impl) {
  grainscope::Arguments arguments(lmp, name_, iarg, narg, arg);
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword(scope_.with({"mode"}));
    if (scope_.read(arguments, keyword)) continue;
    const std::string mode = arguments.choice(keyword, {"instantaneous", "step", "ledger"});
    impl_->mode = mode == "step" ? Mode::step : mode == "ledger" ? Mode::ledger : Mode::instantaneous;
  }
  if (impl_->mode == Mode::ledger) {
    grainscope::require_box(lmp, arguments);
    if (scope_.by_types() || !scope_.type_pair().any() || scope_.within())
      arguments.fail("'mode ledger' has no losses by types or of a region: use 'mode step'");
  }
  using Of = LossSums::Of;
  impl_->sums.mine().of = impl_->mode == Mode::instantaneous ? Of::powers
                          : impl_->mode == Mode::step        ? Of::slip
                                                             : Of::contacts;
  sums_over(impl_->sums);
  if (impl_->mode == Mode::step) sums_over(impl_->damping);
  if (scope_.by_types()) {
    impl_->of_types.reset(new LossesOfTypes(type_pairs(), impl_->sums.mine().of));
    sums_over(*impl_->of_types);
  }
  declare(this, declared(impl_->of_types ? &impl_->of_types->pairs : nullptr));
  require_count(2 * LossSums::WIDTH, outputs().vector, "elements");
  if (impl_->mode == Mode::ledger) FixLedgerRecord::make(lmp, id, igroup, "dissipation mode ledger");
}

ComputeDissipation::~ComputeDissipation() {
  if (impl_->mode == Mode::ledger) FixLedgerRecord::forget(lmp, id);
}

void ComputeDissipation::init() {
  ContactCompute::init();
  require_known_losses();
  impl_->damping.atom = atom;
  impl_->damping.domain = domain;
  impl_->damping.observer = observer_;
  if (impl_->of_types)
    for (LossesOfTypes::Row &row : impl_->of_types->rows) row.damping = impl_->damping;
  if (impl_->mode == Mode::ledger) FixLedgerRecord::find(lmp, id);
}

/** A ledger that does not close, because grains came, does not concern a run that does not use it. */
bool ComputeDissipation::answers_after_run() const { return impl_->mode != Mode::ledger; }

bool ComputeDissipation::needs_images() const { return impl_->mode == Mode::step; }

void ComputeDissipation::answer() {
  if (impl_->mode == Mode::ledger) return answer_by_ledger();
  LossSums sums = impl_->sums.mine();
  if (impl_->mode == Mode::step) impl_->damping.to_powers(sums);
  sum_over_ranks(sums.all.data(), sums.all.size());
  put(sums.all.data());
  if (impl_->of_types) put_rows();
}

void ComputeDissipation::put_rows() {
  const std::vector<std::pair<int, int>> pairs = impl_->of_types->pairs.all();
  for (std::size_t row = 0; row < pairs.size(); row++) {
    const LossesOfTypes::Row &of_pair = impl_->of_types->rows[row];
    LossSums sums = of_pair.sums;
    if (impl_->of_types->by_steps()) of_pair.damping.to_powers(sums);
    array[row][0] = pairs[row].first;
    array[row][1] = pairs[row].second;
    for (std::size_t k = 0; k < sums.all.size(); k++) array[row][2 + k] = sums.all[k] + 0.0;  // no negative zeros
    sum_over_ranks(array[row] + 2, sums.all.size());
  }
}

void ComputeDissipation::put(const double *values) {
  for (int k = 0; k < size_vector; k++) vector[k] = values[k] + 0.0;  // no negative zeros
  scalar = 0.0;
  for (int first : {0, static_cast<int>(LossSums::WIDTH)})
    for (int k : {LossSums::normal_damping, LossSums::friction, LossSums::tangential_damping})
      scalar += vector[first + k];
}

void ComputeDissipation::answer_by_ledger() {
  using E = grainscope::EnergyLedger;
  const auto last = FixLedgerRecord::find(lmp, id)->account().last;
  LossSums sums = impl_->sums.total(*this);
  const struct {
    int loss;
    E::Entry all, of_walls;
  } losses[] = {{LossSums::normal_damping, E::D_n, E::D_n_w},
                {LossSums::friction, E::D_t, E::D_t_w},
                {LossSums::tangential_damping, E::D_damp, E::D_damp_w}};
  for (const auto &one : losses) {
    if (scope_.chosen_walls() != grainscope::Walls::only)
      sums.of_grains()[one.loss] = (last[one.all] - last[one.of_walls]) / update->dt;
    if (scope_.chosen_walls() != grainscope::Walls::no) sums.of_walls()[one.loss] = last[one.of_walls] / update->dt;
  }
  put(sums.all.data());
}

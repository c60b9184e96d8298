// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_press_strain.h"
#include "contact_observer.h"
#include "fluctuations.h"
#include "pair_gran_insitu.h"
#include "press_strain_host_arguments.h"
#include "press_strain_impl.h"
#include "press_strain_requirements.h"
#include "restart_state.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "force.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;
using grainscope::box_modes;
using grainscope::BoxJump;
using grainscope::BoxMotion;
using grainscope::BoxRates;
using grainscope::BoxState;
using grainscope::loops;
using grainscope::mean_loop;
using grainscope::MomentumFlux;
using grainscope::NetworkResponse;
using grainscope::number_of_box_modes;
using grainscope::press_strain_error;
using grainscope::PressStrainHostArguments;
using Every = grainscope::PressStrainSettings::Every;
using How = BoxMotion::How;

namespace {

/** In restart files. The window is summed over ranks, so that any number of them may continue. */
struct SavedControl {
  static constexpr std::uint32_t version = 2;
  double strain, averaged_pressure, inputs, clipped;
  grainscope::PressStrainDriven driven;
  double strains[number_of_box_modes], clipped_of[loops];
  NetworkResponse window;
  double window_steps, planned_steps;
  double every, interval, passed, next;  // how inputs are counted, and how far
  double controlled;                     // modes whose stiffness is in the window, as bits
};

std::array<bool, number_of_box_modes> turned_back(const grainscope::PressStrainSettings &settings) {
  std::array<bool, number_of_box_modes> turns{};
  for (int k = 3; k < number_of_box_modes; k++) turns[k] = settings.motions[k].given;
  return turns;
}

}

FixPressStrain::Impl::Impl(LAMMPS *lmp, int narg, char **arg)
    : settings(lmp, narg, arg), dimension(lmp->domain->dimension), controlled(settings.controlled_modes(dimension)),
      pairs(controlled), box(lmp, turned_back(settings)), intervals(settings.interval), forecast(lmp, settings) {}

double FixPressStrain::Impl::controlled_bits() const {
  double bits = 0.0;
  for (int mode : controlled) bits += 1 << mode;
  return bits;
}

/** Relative rate of an edge, shear rate of a tilt. */
double FixPressStrain::Impl::true_rate(int mode) const {
  const BoxMotion &motion = settings.motions[mode];
  if (motion.how == How::rate) return motion.value.value;
  if (motion.how == How::mean) return driven.mean_rate * motion.ratio;
  if (motion.how == How::still) return 0.0;
  return mode < 3 ? driven.rates[mode] / box.length(mode) : driven.rates[mode];
}

/** The rates by which the box is moved: for edges with targets dL/dt is held. `ahead`: the time after which the box has
 *  the length to which the true rates of edges refer. */
BoxRates FixPressStrain::Impl::rates(double ahead) const {
  BoxRates all{};
  for (int k = 0; k < number_of_box_modes; k++)
    all[k] = k >= 3                                   ? true_rate(k)
             : settings.motions[k].how == How::target ? driven.rates[k]
                                                      : true_rate(k) * box.length(k) / (1.0 - true_rate(k) * ahead);
  return all;
}

FixPressStrain::FixPressStrain(LAMMPS *lmp, int narg, char **arg)
    : FixPressStrain(lmp, narg, arg, PressStrainHostArguments(lmp, narg, arg)) {}

FixPressStrain::FixPressStrain(LAMMPS *lmp, int narg, char **arg, const PressStrainHostArguments &host)
    : FixDeform(lmp, host.size(), host.words()), impl_(new Impl(lmp, narg, arg)) {
  // The box and its velocity remapping act on every grain; the group only defines whose drift is removed.
  impl_->momentum_groupbit = groupbit;
  impl_->momentum_group = arg[1];
  igroup = 0;
  groupbit = 1;
  restart_global = 1;
  restart_pbc = 0;  // the host's wrapping would move triclinic positions by an ulp
  declare(this, "press/strain", Impl::declared());
  global_freq = 1;
  grainscope::PressStrainRequirements(lmp, this, impl_->settings).require_controllable_box(impl_->box);
}

/** The box stands still from now on, also for grains beyond a face. */
FixPressStrain::~FixPressStrain() {
  const BoxState before(lmp);
  impl_->box.set_rates(BoxRates{});
  give_new_velocity_outside(before);
}

void FixPressStrain::init() {
  Impl &my = *impl_;
  const grainscope::PressStrainRequirements requirements(lmp, this, my.settings);
  requirements.require_controllable_box(my.box);
  requirements.require_group(my.momentum_group.c_str(), my.momentum_groupbit);
  my.observer = &PairGranInsitu::required_by(lmp, "fix press/strain")->observer();
  my.observer->add(this);
  my.settings.evaluate_rates(lmp);
  const BoxState before(lmp);
  my.box.set_rates(my.rates());
  give_new_velocity_outside(before);  // grains that the run before left beyond a face
  my.jump.reset();
  plan_flip();
}

void FixPressStrain::setup(int) {
  grainscope::PressStrainRequirements(lmp, this, impl_->settings).require_known_stiffness();
  evaluate_variables();
  impl_->forecast.check(time_between_inputs());
}

/** Every step, so that the computes that a variable uses can be requested for the next step. */
void FixPressStrain::evaluate_variables() {
  auto &settings = impl_->settings;
  if (!settings.follows_variables()) return;
  modify->clearstep_compute();
  settings.evaluate_rates(lmp);
  settings.evaluate_targets(lmp);
  modify->addstep_compute(update->ntimestep + 1);
}

void FixPressStrain::begin_contacts() {
  impl_->now = NetworkResponse();
  impl_->lanes.reset();
  impl_->pressure_step = -1;
}

void FixPressStrain::add_contacts(grainscope::ContactSpan contacts) {
  for (const grainscope::Contact &contact : contacts) impl_->now.add(contact, impl_->pairs);
}

void FixPressStrain::add_lanes(const grainscope::ContactLanes &contacts) { impl_->lanes.add(contacts, impl_->pairs); }

void FixPressStrain::end_contacts() { impl_->now.add(impl_->lanes.sum(), 1.0); }

void FixPressStrain::plan_flip() {
  if (!impl_->box.needs_flip()) return;
  impl_->flip_pending = true;
  next_reneighbor = update->ntimestep + 1;
}

void FixPressStrain::pre_exchange() {
  if (!impl_->flip_pending) return;
  impl_->flip_pending = false;
  impl_->box.flip(impl_->rates());
}

/** Rate of the strain that inputs are counted in. */
double FixPressStrain::strain_rate() const {
  double rates[number_of_box_modes];
  for (int k = 0; k < number_of_box_modes; k++) rates[k] = impl_->true_rate(k);
  return impl_->settings.strain_rate(rates);
}

/** How far one step brings the quantity that inputs are counted in. */
double FixPressStrain::progress_of_a_step() const {
  switch (impl_->settings.every) {
    case Every::strain: return strain_rate() * update->dt;
    case Every::time: return update->dt;
    default: return 1.0;
  }
}

/** The longest that an interval lasts: inputs fall on whole steps. */
double FixPressStrain::time_between_inputs() const {
  return std::ceil(impl_->settings.interval / progress_of_a_step() - 1e-9) * update->dt;
}

/** Kinetic part of the pressures; collective. Zero unless asked for. */
void FixPressStrain::add_kinetic_part(std::array<double, number_of_box_modes> &pressures, double factor) const {
  if (!impl_->settings.kinetic) return;
  const BoxState &box = impl_->observer->box();
  const Eigen::Matrix3d flux = MomentumFlux::of(lmp, {"fix press/strain", groupbit}, box).sum;
  for (int k = 0; k < number_of_box_modes; k++)
    pressures[k] += flux(box_modes[k].flow, box_modes[k].gradient) * force->mvv2e * force->nktv2p / box.volume * factor;
}

void FixPressStrain::end_of_step() {
  Impl &my = *impl_;
  my.window.add(my.now, force->nktv2p / my.observer->box().volume);
  add_kinetic_part(my.window.pressure, 1.0 / comm->nprocs);
  my.window_steps += 1.0;

  evaluate_variables();
  my.strain += strain_rate() * update->dt;
  const BoxState before(lmp);
  // The velocities of an input, as its rates, are planned for the time until the next input: a strain that has grown
  // more slowly since then does not prolong that time.
  const bool due = my.intervals.advance(progress_of_a_step());
  if (due || (my.planned_steps > 0.0 && my.window_steps > my.planned_steps)) take_input();
  // The box moves by the rates of its images in the next step: the springs of contacts across faces follow velocities,
  // overlaps follow the box.
  for (int k = 3; k < number_of_box_modes; k++) my.strains[k] += my.true_rate(k) * update->dt;
  my.box.advance(my.rates(update->dt));
  for (int k = 0; k < 3; k++)
    if (my.settings.motions[k].moves()) my.strains[k] += std::log(my.box.length(k) / before.edges(k, k));
  give_new_velocity_outside(before);
  plan_flip();
}

/** To grains that are to be wrapped at the next neighbour list. */
void FixPressStrain::give_new_velocity_outside(const BoxState &before) {
  impl_->jump.reset(new BoxJump(before, grainscope::upper_triangular(domain->h_rate)));
  if (!impl_->jump->none() && atom->nlocal > 0) impl_->jump->give(atom->x[0], atom->v[0], atom->nlocal);
}

const BoxJump *FixPressStrain::last_jump_of(LAMMPS *lmp) {
  for (int k = 0; k < lmp->modify->nfix; k++)
    if (const auto *fix = dynamic_cast<const FixPressStrain *>(lmp->modify->fix[k])) return fix->impl_->jump.get();
  return nullptr;
}

/** Collective, once per evaluation; the last values when the pair style has been replaced since. */
const std::array<double, number_of_box_modes> &FixPressStrain::pressures_now() {
  Impl &my = *impl_;
  if (my.pressure_step == update->ntimestep || !attached()) return my.pressures;
  my.observer->require_complete("fix press/strain");
  my.pressure_step = update->ntimestep;
  for (int k = 0; k < number_of_box_modes; k++)
    my.pressures[k] = my.now.pressure[k] * force->nktv2p / my.observer->box().volume;
  MPI_Allreduce(MPI_IN_PLACE, my.pressures.data(), number_of_box_modes, MPI_DOUBLE, MPI_SUM, world);
  add_kinetic_part(my.pressures, 1.0);
  return my.pressures;
}

double FixPressStrain::compute_scalar() { return impl_->averaged_pressure; }

double FixPressStrain::compute_vector(int n) { return Impl::elements()[n].value(*this); }

double FixPressStrain::relative_error() const {
  const double target = impl_->main_target();
  return target > 0.0 && impl_->averaged ? impl_->averaged_pressure / target - 1.0 : 0.0;
}

void FixPressStrain::write_restart(FILE *file) {
  Impl &my = *impl_;
  NetworkResponse sums = my.window;
  MPI_Allreduce(MPI_IN_PLACE, &sums, 48, MPI_DOUBLE, MPI_SUM, world);
  my.window = NetworkResponse();
  if (comm->me != 0) return;
  // as a continued run will have it: the run that goes on stays equal to it, bit by bit
  my.window = sums;
  SavedControl saved{my.strain,
                     my.averaged_pressure,
                     my.inputs,
                     my.clipped,
                     my.driven,
                     {},
                     {},
                     sums,
                     my.window_steps,
                     my.planned_steps,
                     static_cast<double>(my.settings.every),
                     my.settings.interval,
                     my.intervals.passed(),
                     my.intervals.next(),
                     my.controlled_bits()};
  std::copy(std::begin(my.strains), std::end(my.strains), saved.strains);
  std::copy(std::begin(my.clipped_of), std::end(my.clipped_of), saved.clipped_of);
  grainscope::write_state(file, saved);
}

void FixPressStrain::restart(char *buffer) {
  Impl &my = *impl_;
  const auto saved = grainscope::read_state<SavedControl>(lmp, *this, "press/strain", buffer);
  my.strain = saved.strain;
  my.inputs = saved.inputs;
  my.clipped = saved.clipped;
  // A stage of a path may hold other stresses than the stage before: their rates begin at 0.
  for (int k = 0; k < loops; k++) {
    my.clipped_of[k] = saved.clipped_of[k];
    if (!my.holds(k)) continue;
    my.driven.bases[k] = saved.driven.bases[k];
    if (k == mean_loop) my.driven.mean_rate = saved.driven.mean_rate;
    else my.driven.rates[k] = saved.driven.rates[k];
  }
  std::copy(std::begin(saved.strains), std::end(saved.strains), my.strains);
  // If inputs are counted in another way than before, or other modes are controlled, inputs begin again, with one at
  // the first step.
  if (static_cast<double>(my.settings.every) != saved.every || my.settings.interval != saved.interval ||
      my.controlled_bits() != saved.controlled)
    return;
  my.averaged_pressure = saved.averaged_pressure;
  my.averaged = saved.inputs > 0.0;
  my.window_steps = saved.window_steps;
  my.planned_steps = saved.planned_steps;
  if (comm->me == 0) my.window = saved.window;
  my.intervals.restore(saved.passed, saved.next);
}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_press_strain.h"
#include "clipping_watch.h"
#include "contact_observer.h"
#include "fluctuations.h"
#include "pair_gran_insitu.h"
#include "press_strain_forecast.h"
#include "press_strain_host_arguments.h"
#include "press_strain_requirements.h"
#include "press_strain_settings.h"
#include "restart_state.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "force.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;
using grainscope::Fluctuations;
using grainscope::NetworkResponse;
using grainscope::press_strain_error;
using grainscope::PressStrainHostArguments;
using Every = grainscope::PressStrainSettings::Every;

namespace {

/** In restart files. The window is summed over ranks, so that any number of them may continue. */
struct SavedControl {
  static constexpr std::uint32_t version = 1;
  double strain, velocity, averaged_pressure, inputs, clipped;
  double window_steps, window_pressure, window_stiffness, window_damping;
  double every, interval, passed, next;  // how inputs are counted, and how far
};

}

struct FixPressStrain::Impl {
  Impl(LAMMPS *lmp, int narg, char **arg)
      : settings(lmp, narg, arg), box(lmp, settings.axis, settings.shear), intervals(settings.interval),
        forecast(lmp, settings) {}

  grainscope::PressStrainSettings settings;
  grainscope::ShearedBox box;
  grainscope::Intervals intervals;
  grainscope::PressStrainForecast forecast;
  int momentum_groupbit = 1;
  std::string momentum_group;
  grainscope::ContactObserver *observer = nullptr;

  bool flip_pending = false;

  NetworkResponse now;     // this rank's sums of the last evaluation, over volume
  NetworkResponse window;  // the same since the last input
  double window_steps = 0.0;
  double strain = 0.0, velocity = 0.0, averaged_pressure = 0.0, inputs = 0.0, clipped = 0.0;
  grainscope::ClippingWatch clipping;
  bigint pressure_step = -1;
  double pressure = 0.0;

  /** What an element of the vector is, and its value. */
  struct Element {
    grainscope::NamedOutput output;
    double (*value)(FixPressStrain &);
  };
  static const std::vector<Element> &elements();
  static grainscope::Outputs declared();
};

const std::vector<FixPressStrain::Impl::Element> &FixPressStrain::Impl::elements() {
  using F = FixPressStrain;
  constexpr auto intensive = grainscope::Extent::intensive;
  static const std::vector<Element> all = {
      {{"strain", "-", intensive, "accumulated strain, sum of |rate| dt"}, [](F &f) { return f.impl_->strain; }},
      {{"target", "pressure", intensive, "pressure to hold, P_t"}, [](F &f) { return f.impl_->settings.target.value; }},
      {{"P", "pressure", intensive, "pressure of this step's contacts"}, [](F &f) { return f.pressure_now(); }},
      {{"L", "distance", intensive, "box length along the axis"}, [](F &f) { return f.impl_->box.length(); }},
      {{"L_rate", "velocity", intensive, "dL/dt"}, [](F &f) { return f.impl_->velocity; }},
      {{"inputs", "-", intensive, "inputs so far"}, [](F &f) { return f.impl_->inputs; }},
      {{"clipped", "-", intensive, "inputs clipped so far"}, [](F &f) { return f.impl_->clipped; }},
      {{"error", "-", intensive, "P_mean/P_t - 1, 0 when P_t is 0"}, [](F &f) { return f.relative_error(); }}};
  return all;
}

grainscope::Outputs FixPressStrain::Impl::declared() {
  grainscope::Outputs outputs;
  outputs.scalar = {
      {"P_mean", "pressure", grainscope::Extent::intensive, "pressure averaged over the last completed interval"}};
  for (const Element &one : elements()) outputs.vector.add(one.output);
  return outputs;
}

FixPressStrain::FixPressStrain(LAMMPS *lmp, int narg, char **arg)
    : FixPressStrain(lmp, narg, arg, PressStrainHostArguments(lmp, narg, arg)) {}

FixPressStrain::FixPressStrain(LAMMPS *lmp, int narg, char **arg, const PressStrainHostArguments &host)
    : FixDeform(lmp, host.size(), host.words()), impl_(new Impl(lmp, narg, arg)) {
  // The box and its velocity remapping concern every grain; the group only says whose drift is removed.
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

FixPressStrain::~FixPressStrain() {}

void FixPressStrain::init() {
  Impl &my = *impl_;
  const grainscope::PressStrainRequirements requirements(lmp, this, my.settings);
  requirements.require_controllable_box(my.box);
  requirements.require_group(my.momentum_group.c_str(), my.momentum_groupbit);
  my.observer = &PairGranInsitu::required_by(lmp, "fix press/strain")->observer();
  my.observer->add(this);
  my.settings.evaluate_rate(lmp);
  my.box.set_rates(my.velocity, my.settings.rate.value);
  plan_flip();
}

void FixPressStrain::setup(int) {
  grainscope::PressStrainRequirements(lmp, this, impl_->settings).require_known_stiffness();
  evaluate_variables();
  impl_->forecast.check(time_between_inputs());
}

/** Every step, so that the computes that a variable uses can be announced for the next one. */
void FixPressStrain::evaluate_variables() {
  auto &settings = impl_->settings;
  if (settings.target.variable.empty() && settings.rate.variable.empty()) return;
  modify->clearstep_compute();
  settings.evaluate_rate(lmp);
  settings.evaluate_target(lmp);
  modify->addstep_compute(update->ntimestep + 1);
}

void FixPressStrain::begin_contacts() {
  impl_->now = NetworkResponse();
  impl_->pressure_step = -1;
}

void FixPressStrain::add_contacts(grainscope::ContactSpan contacts) {
  for (const grainscope::Contact &contact : contacts) impl_->now.add(contact, impl_->settings.axis);
}

void FixPressStrain::plan_flip() {
  if (!impl_->box.needs_flip()) return;
  impl_->flip_pending = true;
  next_reneighbor = update->ntimestep + 1;
}

void FixPressStrain::pre_exchange() {
  if (!impl_->flip_pending) return;
  impl_->flip_pending = false;
  impl_->box.flip(impl_->velocity, impl_->settings.rate.value);
}

/** How far one step brings the quantity that inputs are counted in. */
double FixPressStrain::progress_of_a_step() const {
  switch (impl_->settings.every) {
    case Every::strain: return std::fabs(impl_->settings.rate.value) * update->dt;
    case Every::time: return update->dt;
    default: return 1.0;
  }
}

/** The longest that an interval lasts: inputs fall on whole steps. */
double FixPressStrain::time_between_inputs() const {
  return std::ceil(impl_->settings.interval / progress_of_a_step() - 1e-9) * update->dt;
}

/** Kinetic part of the pressure; collective. Zero unless asked for. */
double FixPressStrain::kinetic_pressure() const {
  if (!impl_->settings.kinetic) return 0.0;
  const grainscope::BoxState &box = impl_->observer->box();
  const int axis = impl_->settings.axis;
  return Fluctuations(lmp, {"fix press/strain", groupbit}, box).momentum_flux()(axis, axis) * force->mvv2e *
         force->nktv2p / box.volume;
}

void FixPressStrain::end_of_step() {
  Impl &my = *impl_;
  my.window.add(my.now, force->nktv2p / my.observer->box().volume);
  my.window.pressure += kinetic_pressure() / comm->nprocs;
  my.window_steps += 1.0;

  evaluate_variables();
  if (my.settings.shear) my.strain += std::fabs(my.settings.rate.value) * update->dt;
  if (my.intervals.advance(progress_of_a_step())) take_input();
  // The box moves by the rates that its images take in the coming step: the springs of contacts across faces follow
  // velocities, overlaps the box.
  my.box.set_rates(my.velocity, my.settings.rate.value);
  my.box.advance();
  my.box.set_rates(my.velocity, my.settings.rate.value);
  plan_flip();
}

void FixPressStrain::take_input() {
  Impl &my = *impl_;
  double sums[3] = {my.window.pressure, my.window.stiffness, my.window.damping};
  MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, world);
  NetworkResponse mean;
  mean.add({sums[0], sums[1], sums[2]}, 1.0 / my.window_steps);
  my.averaged_pressure = mean.pressure;
  my.window = NetworkResponse();
  my.window_steps = 0.0;

  if (my.settings.remove_momentum) {
    const Eigen::Vector3d drift =
        Fluctuations(lmp, {"fix press/strain", my.momentum_groupbit}, my.observer->box()).drift();
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & my.momentum_groupbit)
        for (int k = 0; k < 3; k++) atom->v[i][k] -= drift[k];
  }
  const auto input = my.settings.control.input(mean, my.settings.target.value, my.box.length(), time_between_inputs());
  my.velocity = input.velocity;
  my.inputs += 1.0;
  if (input.clipped) my.clipped += 1.0;
  my.clipping.watch(lmp, my.inputs, input);
}

/** Collective, once per evaluation; the last value when the pair style has been replaced since. */
double FixPressStrain::pressure_now() {
  Impl &my = *impl_;
  if (my.pressure_step == update->ntimestep || !attached()) return my.pressure;
  my.observer->require_complete("fix press/strain");
  my.pressure_step = update->ntimestep;
  my.pressure = my.now.pressure * force->nktv2p / my.observer->box().volume;
  MPI_Allreduce(MPI_IN_PLACE, &my.pressure, 1, MPI_DOUBLE, MPI_SUM, world);
  my.pressure += kinetic_pressure();
  return my.pressure;
}

double FixPressStrain::compute_scalar() { return impl_->averaged_pressure; }

double FixPressStrain::compute_vector(int n) { return Impl::elements()[n].value(*this); }

double FixPressStrain::relative_error() const {
  const double target = impl_->settings.target.value;
  return target > 0.0 && impl_->inputs > 0.0 ? impl_->averaged_pressure / target - 1.0 : 0.0;
}

void FixPressStrain::write_restart(FILE *file) {
  Impl &my = *impl_;
  double sums[3] = {my.window.pressure, my.window.stiffness, my.window.damping};
  MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, world);
  my.window = NetworkResponse();
  if (comm->me != 0) return;
  // as a continued run will have it: the run that goes on stays equal to it, bit by bit
  my.window = {sums[0], sums[1], sums[2]};
  grainscope::write_state(file, SavedControl{my.strain, my.velocity, my.averaged_pressure, my.inputs, my.clipped,
                                             my.window_steps, sums[0], sums[1], sums[2],
                                             static_cast<double>(my.settings.every), my.settings.interval,
                                             my.intervals.passed(), my.intervals.next()});
}

void FixPressStrain::restart(char *buffer) {
  Impl &my = *impl_;
  const auto saved = grainscope::read_state<SavedControl>(lmp, *this, "press/strain", buffer);
  my.strain = saved.strain;
  my.velocity = saved.velocity;
  my.averaged_pressure = saved.averaged_pressure;
  my.inputs = saved.inputs;
  my.clipped = saved.clipped;
  my.window_steps = saved.window_steps;
  if (comm->me == 0) my.window = {saved.window_pressure, saved.window_stiffness, saved.window_damping};
  // Counted otherwise than before, inputs begin again, with one at the first step.
  if (static_cast<double>(my.settings.every) == saved.every && my.settings.interval == saved.interval)
    my.intervals.restore(saved.passed, saved.next);
}

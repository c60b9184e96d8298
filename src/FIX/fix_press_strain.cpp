// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_press_strain.h"
#include "box_jump.h"
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
#include <functional>

using namespace LAMMPS_NS;
using grainscope::box_modes;
using grainscope::BoxJump;
using grainscope::BoxMotion;
using grainscope::BoxRates;
using grainscope::BoxState;
using grainscope::Fluctuations;
using grainscope::NetworkResponse;
using grainscope::number_of_box_modes;
using grainscope::press_strain_error;
using grainscope::PressStrainHostArguments;
using grainscope::PressureControl;
using Every = grainscope::PressStrainSettings::Every;
using How = BoxMotion::How;

namespace {

/** Loops of the controller: one of each mode of the box, and that of the mean pressure. */
constexpr int mean_loop = number_of_box_modes, loops = mean_loop + 1;
/** Order of tilts in the output: xy, xz, yz. */
constexpr int planes[3] = {5, 4, 3};

/** What inputs have set. */
struct Driven {
  double rates[number_of_box_modes];  // of edges with a target of their own dL/dt, of tilts the shear rate
  double mean_rate;                   // common (dL/dt)/L of the edges that move with the mean, before their ratios
  double bases[loops];                // rates without what errors add to them
};

/** In restart files. The window is summed over ranks, so that any number of them may continue. */
struct SavedControl {
  static constexpr std::uint32_t version = 2;
  double strain, averaged_pressure, inputs, clipped;
  Driven driven;
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

struct FixPressStrain::Impl {
  Impl(LAMMPS *lmp, int narg, char **arg)
      : settings(lmp, narg, arg), dimension(lmp->domain->dimension), controlled(settings.controlled_modes(dimension)),
        pairs(controlled), box(lmp, turned_back(settings)), intervals(settings.interval), forecast(lmp, settings) {}

  grainscope::PressStrainSettings settings;
  int dimension;
  std::vector<int> controlled;  // modes whose stiffness is wanted
  NetworkResponse::Pairs pairs;
  grainscope::ShearedBox box;
  grainscope::Intervals intervals;
  grainscope::PressStrainForecast forecast;
  int momentum_groupbit = 1;
  std::string momentum_group;
  grainscope::ContactObserver *observer = nullptr;

  bool flip_pending = false;

  NetworkResponse now;                             // this rank's sums of the last evaluation, over volume
  NetworkResponse window;                          // the same since the last input
  double window_steps = 0.0, planned_steps = 0.0;  // since the last input; and until the next, as it was planned
  double strain = 0.0, averaged_pressure = 0.0, inputs = 0.0, clipped = 0.0;
  Driven driven{};
  double strains[number_of_box_modes] = {}, clipped_of[loops] = {};
  grainscope::ClippingWatch clipping[loops];
  std::unique_ptr<BoxJump> jump;  // of the last step
  bigint pressure_step = -1;
  std::array<double, number_of_box_modes> pressures{};  // of that step

  bool holds(int loop) const {
    return loop == mean_loop ? settings.has_mean : settings.motions[loop].how == How::target;
  }
  double controlled_bits() const;
  double mean_of(const std::array<double, number_of_box_modes> &of) const;
  double main_of(const std::array<double, number_of_box_modes> &of) const;
  double main_target() const;
  double target_of(int mode) const {
    const BoxMotion &motion = settings.motions[mode];
    return motion.how == How::target ? motion.value.value : 0.0;
  }
  int shown_edge() const;
  double true_rate(int mode) const;
  BoxRates rates(double ahead = 0.0) const;

  /** What an element of the vector is, and its value. */
  struct Element {
    grainscope::NamedOutput output;
    std::function<double(FixPressStrain &)> value;
  };
  static const std::vector<Element> &elements();
  static void add_edges(std::vector<Element> &all);
  static void add_planes(std::vector<Element> &all);
  static grainscope::Outputs declared();
};

const std::vector<FixPressStrain::Impl::Element> &FixPressStrain::Impl::elements() {
  using F = FixPressStrain;
  constexpr auto intensive = grainscope::Extent::intensive;
  static const std::vector<Element> all = [] {
    std::vector<Element> list = {
        {{"strain", "-", intensive, "accumulated strain that inputs count, sum of |rate| dt"},
         [](F &f) { return f.impl_->strain; }},
        {{"target", "pressure", intensive, "pressure to hold, P_t"}, [](F &f) { return f.impl_->main_target(); }},
        {{"P", "pressure", intensive, "pressure of this step's contacts"},
         [](F &f) { return f.impl_->main_of(f.pressures_now()); }},
        {{"L", "distance", intensive, "box length along the axis"},
         [](F &f) { return f.impl_->box.length(f.impl_->shown_edge()); }},
        {{"L_rate", "velocity", intensive, "dL/dt"}, [](F &f) { return f.impl_->rates()[f.impl_->shown_edge()]; }},
        {{"inputs", "-", intensive, "inputs so far"}, [](F &f) { return f.impl_->inputs; }},
        {{"clipped", "-", intensive, "inputs clipped so far"}, [](F &f) { return f.impl_->clipped; }},
        {{"error", "-", intensive, "P_mean/P_t - 1, 0 when P_t is 0"}, [](F &f) { return f.relative_error(); }}};
    add_edges(list);
    add_planes(list);
    list.push_back(
        {{"pressure", "pressure", intensive, "mean of the pressures along the axes, of this step's contacts"},
         [](F &f) { return f.impl_->mean_of(f.pressures_now()); }});
    list.push_back({{"target_mean", "pressure", intensive, "target of the mean pressure, 0 without"},
                    [](F &f) { return f.impl_->settings.has_mean ? f.impl_->settings.mean.value : 0.0; }});
    list.push_back({{"clipped_mean", "-", intensive, "inputs of the mean pressure clipped so far"},
                    [](F &f) { return f.impl_->clipped_of[mean_loop]; }});
    return list;
  }();
  return all;
}

void FixPressStrain::Impl::add_edges(std::vector<Element> &all) {
  using F = FixPressStrain;
  constexpr auto intensive = grainscope::Extent::intensive;
  for (int k = 0; k < 3; k++) {
    const std::string axis(1, "xyz"[k]);
    all.push_back({{"P_" + axis, "pressure", intensive, "pressure along " + axis + " of this step's contacts"},
                   [k](F &f) { return f.pressures_now()[k]; }});
    all.push_back({{"target_" + axis, "pressure", intensive, "pressure to hold along " + axis + ", 0 without"},
                   [k](F &f) { return f.impl_->target_of(k); }});
    all.push_back({{"L_" + axis, "distance", intensive, "box length along " + axis},
                   [k](F &f) { return f.impl_->box.length(k); }});
    all.push_back({{"rate_" + axis, "1/time", intensive, "(dL/dt)/L along " + axis},
                   [k](F &f) { return f.impl_->true_rate(k); }});
    all.push_back({{"strain_" + axis, "-", intensive, "logarithmic strain along " + axis + ", ln(L/L at the start)"},
                   [k](F &f) { return f.impl_->strains[k]; }});
    all.push_back({{"clipped_" + axis, "-", intensive, "inputs of " + axis + " clipped so far"},
                   [k](F &f) { return f.impl_->clipped_of[k]; }});
  }
}

void FixPressStrain::Impl::add_planes(std::vector<Element> &all) {
  using F = FixPressStrain;
  constexpr auto intensive = grainscope::Extent::intensive;
  for (int k : planes) {
    const std::string plane = grainscope::name_of_box_mode(k);
    all.push_back({{"s_" + plane, "pressure", intensive, "shear stress " + plane + " of this step's contacts"},
                   [k](F &f) { return -f.pressures_now()[k]; }});
    all.push_back({{"target_" + plane, "pressure", intensive, "shear stress to hold in " + plane + ", 0 without"},
                   [k](F &f) { return f.impl_->target_of(k); }});
    all.push_back({{"rate_" + plane, "1/time", intensive, "shear rate in " + plane},
                   [k](F &f) { return f.impl_->true_rate(k); }});
    all.push_back({{"strain_" + plane, "-", intensive, "shear strain in " + plane + ", sum of rate dt"},
                   [k](F &f) { return f.impl_->strains[k]; }});
    all.push_back({{"clipped_" + plane, "-", intensive, "inputs of the shear in " + plane + " clipped so far"},
                   [k](F &f) { return f.impl_->clipped_of[k]; }});
  }
}

grainscope::Outputs FixPressStrain::Impl::declared() {
  grainscope::Outputs outputs;
  outputs.scalar = {
      {"P_mean", "pressure", grainscope::Extent::intensive, "pressure averaged over the last completed interval"}};
  for (const Element &one : elements()) outputs.vector.add(one.output);
  return outputs;
}

double FixPressStrain::Impl::controlled_bits() const {
  double bits = 0.0;
  for (int mode : controlled) bits += 1 << mode;
  return bits;
}

double FixPressStrain::Impl::mean_of(const std::array<double, number_of_box_modes> &of) const {
  return (of[0] + of[1] + (dimension == 3 ? of[2] : 0.0)) / dimension;
}

/** The first edge with a target of its own, or else the mean. */
double FixPressStrain::Impl::main_of(const std::array<double, number_of_box_modes> &of) const {
  const int edge = settings.main_edge();
  return edge >= 0 && settings.motions[edge].how == How::target ? of[edge] : mean_of(of);
}

double FixPressStrain::Impl::main_target() const {
  const int edge = settings.main_edge();
  return settings.has_mean ? settings.mean.value : edge >= 0 ? target_of(edge) : 0.0;
}

/** Whose length the first elements give: of the edge that is controlled, or else the first that moves. */
int FixPressStrain::Impl::shown_edge() const {
  if (settings.main_edge() >= 0) return settings.main_edge();
  for (int k = 0; k < 3; k++)
    if (settings.motions[k].moves()) return k;
  return 0;
}

/** Relative rate of an edge, shear rate of a tilt. */
double FixPressStrain::Impl::true_rate(int mode) const {
  const BoxMotion &motion = settings.motions[mode];
  if (motion.how == How::rate) return motion.value.value;
  if (motion.how == How::mean) return driven.mean_rate * motion.ratio;
  if (motion.how == How::still) return 0.0;
  return mode < 3 ? driven.rates[mode] / box.length(mode) : driven.rates[mode];
}

/** As the box is moved: those of edges with targets are held in dL/dt. `ahead`: the time in which the box takes on the
 *  length to which the true rates of edges belong. */
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

/** Every step, so that the computes that a variable uses can be announced for the next one. */
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
  impl_->pressure_step = -1;
}

void FixPressStrain::add_contacts(grainscope::ContactSpan contacts) {
  for (const grainscope::Contact &contact : contacts) impl_->now.add(contact, impl_->pairs);
}

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
  const Eigen::Matrix3d flux = Fluctuations(lmp, {"fix press/strain", groupbit}, box).momentum_flux();
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
  // The velocities that an input sets are meant for the time until the next as the rates are: a strain that grows more
  // slowly since then does not prolong it.
  const bool due = my.intervals.advance(progress_of_a_step());
  if (due || (my.planned_steps > 0.0 && my.window_steps > my.planned_steps)) take_input();
  // The box moves by the rates that its images take in the coming step: the springs of contacts across faces follow
  // velocities, overlaps the box.
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
  if (impl_->jump->none()) return;
  Eigen::Vector3d velocity;
  for (int i = 0; i < atom->nlocal; i++)
    if (impl_->jump->gives(Eigen::Map<const Eigen::Vector3d>(atom->x[i]), velocity))
      Eigen::Map<Eigen::Vector3d>(atom->v[i]) += velocity;
}

const BoxJump *FixPressStrain::last_jump_of(LAMMPS *lmp) {
  for (int k = 0; k < lmp->modify->nfix; k++)
    if (const auto *fix = dynamic_cast<const FixPressStrain *>(lmp->modify->fix[k])) return fix->impl_->jump.get();
  return nullptr;
}

void FixPressStrain::take_input() {
  Impl &my = *impl_;
  static_assert(sizeof(NetworkResponse) == 48 * sizeof(double), "what ranks add up");
  MPI_Allreduce(MPI_IN_PLACE, &my.window, 48, MPI_DOUBLE, MPI_SUM, world);
  NetworkResponse mean;
  mean.add(my.window, 1.0 / my.window_steps);
  my.averaged_pressure = my.main_of(mean.pressure);
  my.window = NetworkResponse();
  my.window_steps = 0.0;

  if (my.settings.remove_momentum) {
    const Eigen::Vector3d drift =
        Fluctuations(lmp, {"fix press/strain", my.momentum_groupbit}, my.observer->box()).drift();
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & my.momentum_groupbit)
        for (int k = 0; k < 3; k++) atom->v[i][k] -= drift[k];
  }
  my.inputs += 1.0;
  my.planned_steps = std::round(time_between_inputs() / update->dt);
  if (set_driven_rates(mean)) my.clipped += 1.0;
}

/** Of all modes that are controlled, at an input; true if one was clipped. */
bool FixPressStrain::set_driven_rates(const NetworkResponse &mean) {
  Impl &my = *impl_;
  const PressureControl &control = my.settings.control;
  const double interval = time_between_inputs();
  bool clipped = false;
  const auto book = [&](int loop, const PressureControl::Input &input) {
    my.clipped_of[loop] += input.clipped ? 1.0 : 0.0;
    my.clipping[loop].watch(lmp, my.inputs, input, loop < 3 || loop == mean_loop ? "pressure" : "shear stress");
    clipped = clipped || input.clipped;
    return input.velocity;
  };
  // Beside an edge that is driven the others have to go on moving.
  const bool edges_go_on = my.settings.drives_an_edge();
  const auto input = [&](int loop, double error, double resistance, double stiffness, double length, bool goes_on) {
    return book(loop, goes_on ? control.input_with_base(error, resistance, stiffness * interval, length, interval,
                                                        my.driven.bases[loop])
                              : control.input(error, resistance, length, interval));
  };
  for (int k = 0; k < number_of_box_modes; k++) {
    if (my.settings.motions[k].how != How::target) continue;
    const double resistance = resistance_of(mean, k, interval);
    const double stiffness = mean.stiffness[NetworkResponse::place(k, k)];
    my.driven.rates[k] =
        k < 3 ? input(k, mean.pressure[k] - my.target_of(k), resistance, stiffness, my.box.length(k), edges_go_on)
              : input(k, mean.pressure[k] + my.target_of(k), resistance + inertial_resistance(mean, k), stiffness, 1.0,
                      true);
  }
  if (my.settings.has_mean)
    my.driven.mean_rate = input(mean_loop, my.mean_of(mean.pressure) - my.settings.mean.value,
                                resistance_of(mean, mean_loop, interval), mean_stiffness(mean), 1.0, edges_go_on);
  return clipped;
}

/** What a loop's stress answers at most to the rates of all loops together, per unit rate of each. */
double FixPressStrain::resistance_of(const NetworkResponse &mean, int loop, double interval) const {
  // |answer of mode a| to the rates of all loops
  const auto answer = [&](int a) {
    double sum = 0.0;
    for (int b = 0; b < number_of_box_modes; b++) {
      const BoxMotion &motion = impl_->settings.motions[b];
      if (motion.controlled()) sum += std::fabs(mean.resistance(a, b, interval)) * motion.ratio;
    }
    return sum;
  };
  if (loop != mean_loop) return answer(loop);
  double sum = 0.0;
  for (int a = 0; a < impl_->dimension; a++) sum += answer(a) / impl_->dimension;
  return sum;
}

/** Of the mean pressure against the common rate. */
double FixPressStrain::mean_stiffness(const NetworkResponse &mean) const {
  double sum = 0.0;
  for (int a = 0; a < impl_->dimension; a++)
    for (int b = 0; b < impl_->dimension; b++) {
      const BoxMotion &motion = impl_->settings.motions[b];
      if (motion.how == How::mean)
        sum += mean.stiffness[NetworkResponse::place(a, b)] * motion.ratio / impl_->dimension;
    }
  return sum;
}

/** Of a shear: h sqrt(rho K), h the edge along its gradient, rho the mass per volume of the box: that of a time in which
 *  sound crosses the box. Tangential springs need not be damped, and inputs in step with their vibrations would feed
 *  them. Collective. */
double FixPressStrain::inertial_resistance(const NetworkResponse &mean, int mode) const {
  double mass = 0.0;
  for (int i = 0; i < atom->nlocal; i++) mass += atom->rmass[i];
  MPI_Allreduce(MPI_IN_PLACE, &mass, 1, MPI_DOUBLE, MPI_SUM, world);
  const double unit = force->mvv2e * force->nktv2p, stiffness = mean.stiffness[NetworkResponse::place(mode, mode)];
  return impl_->box.length(box_modes[mode].gradient) *
         std::sqrt(mass / impl_->observer->box().volume * stiffness * unit);
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
  return target > 0.0 && impl_->inputs > 0.0 ? impl_->averaged_pressure / target - 1.0 : 0.0;
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
  // The next stage of a path holds other stresses: the rest begins anew.
  for (int k = 0; k < loops; k++) {
    my.clipped_of[k] = saved.clipped_of[k];
    if (!my.holds(k)) continue;
    my.driven.bases[k] = saved.driven.bases[k];
    if (k == mean_loop) my.driven.mean_rate = saved.driven.mean_rate;
    else my.driven.rates[k] = saved.driven.rates[k];
  }
  std::copy(std::begin(saved.strains), std::end(saved.strains), my.strains);
  // Counted otherwise than before, or of other modes, inputs begin again, with one at the first step.
  if (static_cast<double>(my.settings.every) != saved.every || my.settings.interval != saved.interval ||
      my.controlled_bits() != saved.controlled)
    return;
  my.averaged_pressure = saved.averaged_pressure;
  my.window_steps = saved.window_steps;
  my.planned_steps = saved.planned_steps;
  if (comm->me == 0) my.window = saved.window;
  my.intervals.restore(saved.passed, saved.next);
}

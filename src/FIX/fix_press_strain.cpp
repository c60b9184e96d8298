// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_press_strain.h"
#include "arguments.h"
#include "contact_observer.h"
#include "pair_gran_insitu.h"
#include "peculiar_motion.h"
#include "pressure_control.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_wall_gran.h"
#include "force.h"
#include "input.h"
#include "irregular.h"
#include "modify.h"
#include "primitive_wall.h"
#include "update.h"
#include "variable.h"
#include <cstring>

using namespace LAMMPS_NS;
using grainscope::Arguments;
using grainscope::Intervals;
using grainscope::NetworkResponse;
using grainscope::PeculiarMotion;

namespace {

/** A number, or an equal-style variable v_name. */
struct Quantity {
  double value = 0.0;
  std::string variable;
};

/** Where the host keeps a tilt: its index in h and h_rate, the box edges along its flow and its gradient, its name. */
struct Tilt {
  int index, flow, gradient;
  const char *name;
};
const Tilt tilts[3] = {{5, 0, 1, "xy"}, {4, 0, 2, "xz"}, {3, 1, 2, "yz"}};

double &tilt_of(Domain *domain, const Tilt &tilt) {
  return tilt.index == 5 ? domain->xy : tilt.index == 4 ? domain->xz : domain->yz;
}

double value_of(LAMMPS *lmp, const std::string &variable) {
  return lmp->input->variable->compute_equal(lmp->input->variable->find(const_cast<char *>(variable.c_str())));
}

/** Asked at a point that lies on no wall's axis or face; the host's own PrimitiveWall::axis() knows cylinders only. */
bool pushes_along(PrimitiveWall *wall, int axis) {
  double point[3] = {0.1234567891, 0.2345678912, 0.3456789123}, push[3];
  wall->resolveContact(point, 0.0, push);
  return push[axis] != 0.0;
}

enum class Every { strain, time, step };

}

struct FixPressStrain::Impl {
  int axis = 1;
  const Tilt *shear = nullptr;
  Quantity target, rate;
  Every every = Every::strain;
  bool remove_momentum = true, kinetic = false, max_rate_given = false;
  int momentum_groupbit = 1;
  grainscope::PressureControl control;
  Intervals intervals;
  std::unique_ptr<Irregular> irregular;
  grainscope::ContactObserver *observer = nullptr;
  double exponent = 1.5;
  bool sticks = true;
  bool flip_pending = false;

  NetworkResponse now;             // this rank's sums of the last evaluation
  NetworkResponse window;          // this rank's sums since the last input, over volume
  double window_steps = 0.0;
  double strain = 0.0, velocity = 0.0, averaged_pressure = 0.0, inputs = 0.0, clipped = 0.0;
  bigint pressure_step = -1;
  double pressure = 0.0;
};

/** What the base class is told: a deformation at rate zero of the box parameters that this fix moves, with velocities remapped. */
struct FixPressStrain::HostArguments {
  std::vector<std::string> words;
  std::vector<char *> pointers;

  HostArguments(LAMMPS *lmp, int narg, char **arg) : words{narg > 0 ? arg[0] : "?", narg > 1 ? arg[1] : "all", "deform", "1"} {
    std::string axis = "y", shear;
    for (int k = 3; k + 1 < narg; k++) {
      if (!strcmp(arg[k], "axis") && strlen(arg[k + 1]) == 1 && strchr("xyz", arg[k + 1][0])) axis = arg[k + 1];
      for (const Tilt &tilt : tilts)
        if (!strcmp(arg[k], "shear") && !strcmp(arg[k + 1], tilt.name)) shear = tilt.name;
    }
    for (const std::string &one : {axis, lmp->domain->triclinic ? shear : std::string()})
      if (!one.empty()) words.insert(words.end(), {one, "vel", "0"});
    words.insert(words.end(), {"remap", "v", "units", "box"});
    for (std::string &word : words) pointers.push_back(&word[0]);
  }
};

FixPressStrain::FixPressStrain(LAMMPS *lmp, int narg, char **arg) : FixPressStrain(lmp, narg, arg, HostArguments(lmp, narg, arg)) {}

FixPressStrain::FixPressStrain(LAMMPS *lmp, int narg, char **arg, const HostArguments &host)
    : FixDeform(lmp, host.pointers.size(), const_cast<char **>(host.pointers.data())), impl_(new Impl) {
  Impl &my = *impl_;
  Arguments arguments(lmp, "fix press/strain", 3, narg, arg);
  bool axis_given = false, target_given = false, every_given = false;
  const auto quantity = [&](const std::string &keyword, const std::string &requirement, bool (*accept)(double)) {
    Quantity q;
    const std::string word = arguments.word(requirement);
    if (word.compare(0, 2, "v_") == 0) q.variable = word.substr(2);
    else if (!Arguments::is_number(word, q.value) || !accept(q.value)) arguments.fail(keyword, requirement, word);
    return q;
  };
  const auto positive = [](double x) { return x > 0.0; };

  while (!arguments.done()) {
    const std::string keyword = arguments.word("a keyword");
    if (keyword == "axis") {
      my.axis = arguments.choice(keyword, {"x", "y", "z"})[0] - 'x';
      axis_given = true;
    } else if (keyword == "target") {
      my.target = quantity(keyword, "a pressure >= 0 or a variable v_name", [](double x) { return x >= 0.0; });
      target_given = true;
    } else if (keyword == "shear") {
      const std::string name = arguments.choice(keyword, {"xy", "xz", "yz"});
      for (const Tilt &tilt : tilts)
        if (name == tilt.name) my.shear = &tilt;
      if (arguments.word("'rate'") != "rate") arguments.fail("'shear " + name + "' must be followed by 'rate' and a shear rate");
      my.rate = quantity("rate", "a shear rate other than 0 or a variable v_name", [](double x) { return x != 0.0; });
    } else if (keyword == "every" || keyword == "every/time" || keyword == "every/step") {
      if (every_given) arguments.fail("'every', 'every/time' and 'every/step' exclude each other, got a second one: '" + keyword + "'");
      every_given = true;
      my.every = keyword == "every" ? Every::strain : keyword == "every/time" ? Every::time : Every::step;
      my.intervals = Intervals(my.every == Every::step
          ? arguments.number(keyword, "a whole number of steps >= 1", [](double x) { return x >= 1.0 && x == std::floor(x); })
          : arguments.number(keyword, my.every == Every::strain ? "a strain > 0" : "a time > 0", positive));
    } else if (keyword == "gain") {
      const std::string word = arguments.word("auto or a velocity per pressure >= 0");
      my.control.automatic = word == "auto";
      if (!my.control.automatic && (!Arguments::is_number(word, my.control.gain) || my.control.gain < 0.0))
        arguments.fail(keyword, "auto or a velocity per pressure >= 0", word);
    } else if (keyword == "limit") {
      my.control.limit = arguments.number(keyword, "between 0 and 1, both excluded", [](double x) { return x > 0.0 && x < 1.0; });
    } else if (keyword == "maxrate") {
      my.control.max_rate = arguments.number(keyword, "a rate > 0", positive);
      my.max_rate_given = true;
    } else if (keyword == "momentum") {
      my.remove_momentum = arguments.yes_or_no(keyword);
    } else if (keyword == "kinetic") {
      my.kinetic = arguments.yes_or_no(keyword);
    } else {
      arguments.fail("keywords are axis, target, shear, every, every/time, every/step, gain, limit, maxrate, momentum and kinetic, got '" +
                     keyword + "'");
    }
  }
  if (!axis_given) arguments.fail("'axis x', 'axis y' or 'axis z' is required");
  if (!target_given) arguments.fail("'target' and a pressure are required");
  if (my.every == Every::strain && !my.shear)
    arguments.fail(every_given ? "'every' counts strain, and without 'shear' the box has none: use 'every/time' or 'every/step'"
                               : "without 'shear', 'every/time' or 'every/step' is required");
  if (!every_given) arguments.fail("'every', 'every/time' or 'every/step' is required");
  if (my.shear && !domain->triclinic)
    arguments.fail("'shear' needs a triclinic box: add 'change_box all triclinic' after the grains are in");

  // The box and its velocity remapping concern every grain; the group only says whose drift is removed.
  my.momentum_groupbit = groupbit;
  igroup = 0;
  groupbit = 1;
  if (my.shear) my.irregular.reset(new Irregular(lmp));
  restart_global = 1;
  restart_pbc = 0;  // the host's wrapping would move triclinic positions by an ulp
  scalar_flag = vector_flag = 1;
  size_vector = 8;
  global_freq = 1;
  extscalar = extvector = 0;
  require_controllable_box();
}

FixPressStrain::~FixPressStrain() {}

void FixPressStrain::require_controllable_box() {
  const Impl &my = *impl_;
  const Arguments arguments(lmp, "fix press/strain", 0, 0, nullptr);
  const std::string axis(1, "xyz"[my.axis]);
  const int periodic[3] = {domain->xperiodic, domain->yperiodic, domain->zperiodic};
  if (!periodic[my.axis]) arguments.fail("cannot move box edges along '" + axis + "': the box must be periodic there");
  if (my.shear) {
    if (!periodic[my.shear->flow] || !periodic[my.shear->gradient])
      arguments.fail(std::string("'shear ") + my.shear->name + "' needs a box periodic along both axes");
    for (const Tilt &tilt : tilts)
      if (&tilt != my.shear && tilt_of(domain, tilt) != 0.0)
        arguments.fail(std::string("with 'shear ") + my.shear->name + "' the tilt " + tilt.name + " must be 0, got " +
                       std::to_string(tilt_of(domain, tilt)));
  }
  int deforming = 0;
  for (int k = 0; k < modify->nfix; k++) {
    Fix *fix = modify->fix[k];
    if (!strcmp(fix->style, "deform") && fix != this) deforming++;
    if (fix->rigid_flag || strstr(fix->style, "multisphere")) arguments.fail(std::string("does not work with rigid bodies (fix ") + fix->id + ")");
    FixWallGran *wall = dynamic_cast<FixWallGran *>(fix);
    if (!wall) continue;
    if (wall->is_mesh_wall()) arguments.fail(std::string("cannot move a box that holds a mesh wall (fix ") + fix->id + ")");
    if (wall->primitiveWall() && pushes_along(wall->primitiveWall(), my.axis))
      arguments.fail("cannot move box edges along '" + axis + "': fix " + fix->id + " is a wall on that axis");
  }
  if (deforming) arguments.fail("another fix already deforms the box: only one fix deform or press/strain at a time");
}

void FixPressStrain::init() {
  Impl &my = *impl_;
  require_controllable_box();
  PairGranInsitu *pair = PairGranInsitu::required_by(lmp, "fix press/strain");
  my.observer = &pair->observer();
  my.observer->add(this);
  my.exponent = pair->stressStrainExponent();
  my.sticks = my.observer->law() != grainscope::ContactObserver::TangentialLaw::off;
  for (const Quantity *q : {&my.target, &my.rate})
    if (!q->variable.empty()) {
      const int found = input->variable->find(const_cast<char *>(q->variable.c_str()));
      if (found < 0 || !input->variable->equalstyle(found))
        Arguments(lmp, "fix press/strain", 0, 0, nullptr).fail("v_" + q->variable + " must be the name of an equal-style variable");
    }
  evaluate_rate();
  set_box_rates();
  plan_flip();
}

void FixPressStrain::setup(int) { evaluate_variables(); }

void FixPressStrain::evaluate_rate() {
  Impl &my = *impl_;
  if (!my.rate.variable.empty()) my.rate.value = value_of(lmp, my.rate.variable);
  if (my.shear && (my.rate.value == 0.0 || !std::isfinite(my.rate.value)))
    Arguments(lmp, "fix press/strain", 0, 0, nullptr)
        .fail("rate", "a shear rate other than 0", "v_" + my.rate.variable + " = " + std::to_string(my.rate.value));
  if (!my.max_rate_given) my.control.max_rate = my.shear ? std::fabs(my.rate.value) : HUGE_VAL;
}

/** Every step, so that the computes that a variable uses can be announced for the next one. */
void FixPressStrain::evaluate_variables() {
  Impl &my = *impl_;
  if (my.target.variable.empty() && my.rate.variable.empty()) return;
  modify->clearstep_compute();
  evaluate_rate();
  if (!my.target.variable.empty()) my.target.value = value_of(lmp, my.target.variable);
  modify->addstep_compute(update->ntimestep + 1);
  if (!(my.target.value >= 0.0))
    Arguments(lmp, "fix press/strain", 0, 0, nullptr)
        .fail("target", "a pressure >= 0", "v_" + my.target.variable + " = " + std::to_string(my.target.value));
}

void FixPressStrain::begin_contacts() {
  impl_->now = NetworkResponse();
  impl_->pressure_step = -1;
}

void FixPressStrain::add_contact(const grainscope::Contact &contact) {
  impl_->now.add(contact, impl_->axis, impl_->exponent, impl_->sticks);
}

/** The rates of the box parameters, for the coming step: ghost velocities and the velocity gradient of every measurement follow them.
 *  Tilts with a component along the moved axis keep their shape. */
void FixPressStrain::set_box_rates() {
  const Impl &my = *impl_;
  for (int k = 0; k < 6; k++) domain->h_rate[k] = 0.0;
  for (int k = 0; k < 3; k++) domain->h_ratelo[k] = 0.0;
  domain->h_rate[my.axis] = my.velocity;
  domain->h_ratelo[my.axis] = -0.5 * my.velocity;
  if (!domain->triclinic) return;
  for (const Tilt &tilt : tilts) {
    if (tilt.flow == my.axis) domain->h_rate[tilt.index] += tilt_of(domain, tilt) * my.velocity / domain->prd[my.axis];
    if (&tilt == my.shear) domain->h_rate[tilt.index] += my.rate.value * domain->prd[tilt.gradient];
  }
}

void FixPressStrain::advance_box() {
  const Impl &my = *impl_;
  const double half = 0.5 * domain->h_rate[my.axis] * update->dt;
  domain->boxlo[my.axis] -= half;
  domain->boxhi[my.axis] += half;
  if (domain->triclinic)
    for (const Tilt &tilt : tilts) tilt_of(domain, tilt) += domain->h_rate[tilt.index] * update->dt;
  domain->set_global_box();
  domain->set_local_box();
}

/** A tilt beyond half the box is turned back by one edge on the next step, before its neighbour lists. */
void FixPressStrain::plan_flip() {
  Impl &my = *impl_;
  if (!my.shear || std::fabs(tilt_of(domain, *my.shear)) <= 0.5 * domain->prd[my.shear->flow]) return;
  my.flip_pending = true;
  next_reneighbor = update->ntimestep + 1;
}

/** Grains are first wrapped into the old box and then into the new one, each time with the velocity of the face that they cross. */
void FixPressStrain::pre_exchange() {
  Impl &my = *impl_;
  if (!my.flip_pending) return;
  my.flip_pending = false;
  domain->x2lamda(atom->nlocal);
  domain->pbc();
  domain->lamda2x(atom->nlocal);

  double &tilt = tilt_of(domain, *my.shear);
  const int turn = tilt > 0.0 ? -1 : 1;
  tilt += turn * domain->prd[my.shear->flow];
  domain->set_global_box();
  domain->set_local_box();
  set_box_rates();
  domain->image_flip(my.shear->index == 5 ? turn : 0, my.shear->index == 4 ? turn : 0, my.shear->index == 3 ? turn : 0);

  domain->x2lamda(atom->nlocal);
  domain->pbc();
  my.irregular->migrate_atoms();
  domain->lamda2x(atom->nlocal);
}

/** How far the quantity that inputs are counted in went in this step. */
double FixPressStrain::advance_progress() {
  const Impl &my = *impl_;
  switch (my.every) {
    case Every::strain: return std::fabs(my.rate.value) * update->dt;
    case Every::time: return update->dt;
    default: return 1.0;
  }
}

/** Time until the next input. */
double FixPressStrain::expected_interval() const {
  const Impl &my = *impl_;
  const double interval = my.intervals.interval();
  const double time = my.every == Every::strain ? interval / std::fabs(my.rate.value) : my.every == Every::time ? interval : interval * update->dt;
  return std::max(time, update->dt);
}

void FixPressStrain::end_of_step() {
  Impl &my = *impl_;
  double kinetic = 0.0;
  if (my.kinetic) {
    const PeculiarMotion motion(lmp, groupbit, my.observer->box());
    kinetic = motion.momentum_flux()(my.axis, my.axis) * force->mvv2e / comm->nprocs;
  }
  my.now.pressure += kinetic;
  my.window.add(my.now, force->nktv2p / my.observer->box().volume);
  my.window_steps += 1.0;
  my.pressure_step = -1;

  evaluate_variables();
  if (my.shear) my.strain += std::fabs(my.rate.value) * update->dt;
  advance_box();
  if (my.intervals.advance(advance_progress())) take_input();
  set_box_rates();
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

  if (my.remove_momentum) {
    const Eigen::Vector3d drift = PeculiarMotion(lmp, my.momentum_groupbit, my.observer->box()).drift();
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & my.momentum_groupbit)
        for (int k = 0; k < 3; k++) atom->v[i][k] -= drift[k];
  }
  const auto input = my.control.input(mean, my.target.value, domain->prd[my.axis], expected_interval());
  my.velocity = input.velocity;
  my.inputs += 1.0;
  if (input.clipped) my.clipped += 1.0;
}

double FixPressStrain::pressure_now() {
  Impl &my = *impl_;
  if (my.pressure_step == update->ntimestep || !my.observer) return my.pressure;
  my.pressure_step = update->ntimestep;
  my.pressure = my.now.pressure * force->nktv2p / my.observer->box().volume;
  MPI_Allreduce(MPI_IN_PLACE, &my.pressure, 1, MPI_DOUBLE, MPI_SUM, world);
  return my.pressure;
}

double FixPressStrain::compute_scalar() { return impl_->averaged_pressure; }

double FixPressStrain::compute_vector(int n) {
  const Impl &my = *impl_;
  switch (n) {
    case 0: return my.strain;
    case 1: return my.target.value;
    case 2: return pressure_now();
    case 3: return domain->prd[my.axis];
    case 4: return my.velocity;
    case 5: return my.inputs;
    case 6: return my.clipped;
    default: return my.target.value > 0.0 && my.inputs > 0.0 ? my.averaged_pressure / my.target.value - 1.0 : 0.0;
  }
}

/** State that a continued run needs, as doubles; the window is summed over ranks, so that any number of them may continue. */
void FixPressStrain::write_restart(FILE *file) {
  Impl &my = *impl_;
  double sums[3] = {my.window.pressure, my.window.stiffness, my.window.damping};
  MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, world);
  my.window = NetworkResponse();
  if (comm->me != 0) return;
  my.window = {sums[0], sums[1], sums[2]};  // as a continued run will have it: the run that goes on stays equal to it, bit by bit
  const double state[] = {my.strain, my.velocity, my.averaged_pressure, my.inputs, my.clipped, my.window_steps, sums[0], sums[1], sums[2],
                          my.intervals.interval(), my.intervals.passed(), my.intervals.next()};
  const int size = sizeof state;
  fwrite(&size, sizeof(int), 1, file);
  fwrite(state, sizeof(double), sizeof state / sizeof(double), file);
}

void FixPressStrain::restart(char *buffer) {
  Impl &my = *impl_;
  double state[12];
  memcpy(state, buffer, sizeof state);
  my.strain = state[0];
  my.velocity = state[1];
  my.averaged_pressure = state[2];
  my.inputs = state[3];
  my.clipped = state[4];
  my.window_steps = state[5];
  if (comm->me == 0) my.window = {state[6], state[7], state[8]};
  // With another interval than before, the next input falls on the next multiple of the new one.
  const double interval = my.intervals.interval();
  my.intervals.restore(state[10], interval == state[9] ? state[11] : std::floor(state[10] / interval) + 1.0);
}

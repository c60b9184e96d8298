// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_press_wall.h"
#include "arguments.h"
#include "clipping_watch.h"
#include "contact_observer.h"
#include "grain_shape.h"
#include "pair_gran_insitu.h"
#include "plate_response.h"
#include "press_wall_host_words.h"
#include "press_wall_requirements.h"
#include "press_wall_settings.h"
#include "pressed_mesh.h"
#include "restart_state.h"
#include "atom.h"
#include "comm.h"
#include "force.h"
#include "modify.h"
#include "update.h"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

using namespace LAMMPS_NS;
using grainscope::Arguments;
using grainscope::PlateResponse;
using Every = grainscope::PressWallSettings::Every;

namespace {

const char *const name = "fix press/wall";
const double part_of_a_grain = 0.01;  // what a plate may move between two inputs, of the smallest grain's diameter

/** In restart files. The window is summed over ranks, so that any number of them may continue. */
struct SavedPlate {
  static constexpr std::uint32_t version = 2;
  double toward, travel, velocity, base, averaged_pressure, inputs, clipped;
  double window_steps, window_force, window_stiffness, window_damping;
  double every, interval, passed, next;  // how inputs are counted, and how far
};

}

struct FixPressWall::Impl {
  Impl(LAMMPS *lmp, int narg, char **arg)
      : settings(lmp, narg, arg), mesh(lmp, settings.mesh, settings.axis), requirements(lmp, settings, mesh),
        host(arg, settings.mesh), intervals(settings.interval), toward(settings.toward) {
    mesh.find(nullptr);
  }

  grainscope::PressWallSettings settings;
  grainscope::PressedMesh mesh;
  grainscope::PressWallRequirements requirements;
  grainscope::PressWallHostWords host;
  grainscope::Intervals intervals;
  grainscope::ContactObserver *observer = nullptr;

  double toward;  // where the grains are, along the axis: 1 or -1; 0: not known yet
  /** One contact. */
  struct Part {
    int grain, triangle;
    PlateResponse response;
  };
  std::vector<Part> parts;  // of the last evaluation, on this rank
  PlateResponse now;        // their sum
  PlateResponse window;     // the same since the last input, over the area
  double window_steps = 0.0;
  double density = 0.0;  // the largest of the grains, 0 without any
  double target = 0.0, travel = 0.0, velocity = 0.0, base = 0.0, averaged_pressure = 0.0, inputs = 0.0, clipped = 0.0;
  grainscope::ClippingWatch clipping{name};
  bigint pressure_step = -1;
  double pressure = 0.0;

  double position() const { return toward < 0.0 ? mesh.low() : mesh.high(); }
  double relative_error() const { return inputs > 0.0 ? averaged_pressure / target - 1.0 : 0.0; }

  /** What an element of the vector is, and its value. */
  struct Element {
    grainscope::NamedOutput output;
    double (*value)(FixPressWall &);
  };
  static const std::vector<Element> &elements();
  static grainscope::Outputs declared();
};

const std::vector<FixPressWall::Impl::Element> &FixPressWall::Impl::elements() {
  using F = FixPressWall;
  constexpr auto intensive = grainscope::Extent::intensive;
  static const std::vector<Element> all = {
      {{"travel", "distance", intensive, "displacement of the plate along the axis"},
       [](F &f) { return f.impl_->travel; }},
      {{"target", "pressure", intensive, "pressure to hold, P_t"}, [](F &f) { return f.impl_->target; }},
      {{"P", "pressure", intensive, "pressure of this step's contacts"}, [](F &f) { return f.pressure_now(); }},
      {{"position", "distance", intensive, "coordinate of the plate's foremost node along the axis"},
       [](F &f) { return f.impl_->position(); }},
      {{"V", "velocity", intensive, "velocity of the plate along the axis"}, [](F &f) { return f.impl_->velocity; }},
      {{"inputs", "-", intensive, "control inputs so far"}, [](F &f) { return f.impl_->inputs; }},
      {{"clipped", "-", intensive, "inputs clipped so far"}, [](F &f) { return f.impl_->clipped; }},
      {{"error", "-", intensive, "P_mean/P_t - 1"}, [](F &f) { return f.impl_->relative_error(); }}};
  return all;
}

grainscope::Outputs FixPressWall::Impl::declared() {
  grainscope::Outputs outputs;
  outputs.scalar = {
      {"P_mean", "pressure", grainscope::Extent::intensive, "pressure averaged over the last completed interval"}};
  for (const Element &one : elements()) outputs.vector.add(one.output);
  return outputs;
}

FixPressWall::FixPressWall(LAMMPS *lmp, int narg, char **arg)
    : FixPressWall(lmp, std::unique_ptr<Impl>(new Impl(lmp, narg, arg))) {}

FixPressWall::FixPressWall(LAMMPS *lmp, std::unique_ptr<Impl> impl)
    : FixMoveMesh(lmp, impl->host.size(), impl->host.words()), impl_(std::move(impl)) {
  restart_global = 1;
  declare(this, "press/wall", Impl::declared());
  global_freq = 1;
}

FixPressWall::~FixPressWall() {}

int FixPressWall::setmask() { return FixConst::INITIAL_INTEGRATE | FixConst::PRE_FORCE | FixConst::END_OF_STEP; }

void FixPressWall::post_create() {
  FixMoveMesh::post_create();
  impl_->mesh.keep_velocities();
}

void FixPressWall::init() {
  Impl &my = *impl_;
  my.mesh.find(this);
  FixMoveMesh::init();
  my.settings.target.init();
  my.requirements.require_area();
  my.observer = &PairGranInsitu::required_by(lmp, name)->observer();
  my.observer->add(this);
}

/** Before the first forces of a run, in which the mesh movers of LIGGGHTS leave the mesh at rest. */
void FixPressWall::setup_pre_force(int) {
  impl_->mesh.keep_velocities();
  impl_->mesh.set_velocity(impl_->velocity);
}

void FixPressWall::setup(int) {
  Impl &my = *impl_;
  my.requirements.require_known_stiffness();
  my.requirements.warn_of_smaller_plate();
  my.mesh.locate();
  my.toward = my.requirements.side_of_grains(my.toward, groupbit);
  know_grains();
  evaluate_target();
}

/** The default limits of the motion of the plate, from the size and density of the grains. Collective. */
void FixPressWall::know_grains() {
  Impl &my = *impl_;
  double most[2] = {-std::numeric_limits<double>::infinity(), 0.0};  // minus the smallest diameter, density
  for (int i = 0; i < atom->nlocal; i++) {
    most[0] = std::max(most[0], -grainscope::equivalent_diameter(*atom, i));
    most[1] = std::max(most[1], atom->density[i]);
  }
  MPI_Allreduce(MPI_IN_PLACE, most, 2, MPI_DOUBLE, MPI_MAX, world);
  if (!my.settings.limit_given) my.settings.control.limit = -part_of_a_grain * most[0];
  my.density = most[1];
  my.requirements.require_slow_plate(time_between_inputs());
}

/** Every step, so that the computes that a variable uses can be requested for the next step. */
void FixPressWall::evaluate_target() {
  if (impl_->settings.target_varies) modify->clearstep_compute();
  impl_->target = impl_->settings.target.now();
  if (impl_->settings.target_varies) modify->addstep_compute(update->ntimestep + 1);
}

void FixPressWall::begin_contacts() {
  impl_->parts.clear();
  impl_->pressure_step = -1;
}

void FixPressWall::add_contacts(grainscope::ContactSpan contacts) {
  for (const grainscope::Contact &contact : contacts) {
    if (!contact.with_wall() || !impl_->mesh.has(contact.wall().wall) || !(atom->mask[contact.i] & groupbit)) continue;
    PlateResponse response;
    response.add(contact, impl_->settings.axis);
    impl_->parts.push_back({atom->tag[contact.i], contact.wall().triangle, response});
  }
}

/** In an order that does not depend on the order of triangles, which changes with a restart. */
void FixPressWall::end_contacts() {
  std::vector<Impl::Part> &parts = impl_->parts;
  std::sort(parts.begin(), parts.end(), [](const Impl::Part &one, const Impl::Part &other) {
    return std::tie(one.grain, one.triangle) < std::tie(other.grain, other.triangle);
  });
  impl_->now = PlateResponse();
  for (const Impl::Part &part : parts) impl_->now.add(part.response, 1.0);
}

void FixPressWall::initial_integrate(int) {
  Impl &my = *impl_;
  const double step = my.velocity * update->dt;
  my.mesh.move(step, this);
  my.mesh.set_velocity(my.velocity);
  my.travel += step;
}

/** The longest that an interval lasts: inputs fall on whole steps. */
double FixPressWall::time_between_inputs() const {
  if (impl_->settings.every == Every::step) return impl_->settings.interval * update->dt;
  return std::ceil(impl_->settings.interval / update->dt - 1e-9) * update->dt;
}

/** Of the plate, or of the box across the axis as it was in the last evaluation. */
double FixPressWall::area() const {
  if (impl_->settings.area > 0.0) return impl_->settings.area;
  const grainscope::BoxState &box = impl_->observer->box();
  const int u = (impl_->settings.axis + 1) % 3, v = (impl_->settings.axis + 2) % 3;
  return box.edges.col(u).cross(box.edges.col(v)).norm();
}

void FixPressWall::end_of_step() {
  Impl &my = *impl_;
  my.window.add(my.now, 1.0 / area());
  my.window_steps += 1.0;
  evaluate_target();
  if (my.intervals.advance(my.settings.every == Every::step ? 1.0 : update->dt)) take_input();
}

void FixPressWall::take_input() {
  Impl &my = *impl_;
  double sums[3] = {my.window.force, my.window.stiffness, my.window.damping};
  MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, world);
  PlateResponse mean;
  mean.add({sums[0], sums[1], sums[2]}, 1.0 / my.window_steps);
  my.averaged_pressure = -my.toward * mean.force * force->nktv2p;
  my.window = PlateResponse();
  my.window_steps = 0.0;

  const double interval = time_between_inputs(), elastic = mean.stiffness * interval,
               resistance = mean.damping + elastic, unit = force->nktv2p;
  grainscope::PressureControl control = my.settings.control;
  if (!my.settings.max_rate_given)
    control.max_rate = grainscope::soft_rate(my.target / force->nktv2p, my.density * force->mvv2e);
  const double error = my.averaged_pressure - my.target;
  const auto input = my.settings.base
                         ? control.input_with_base(error, resistance * unit, elastic * unit, 1.0, interval, my.base)
                         : control.input(error, resistance * unit, 1.0, interval);
  my.velocity = -my.toward * input.velocity;
  my.inputs += 1.0;
  if (input.clipped) my.clipped += 1.0;
  my.clipping.watch(lmp, my.inputs, input, "pressure");
}

/** Collective, once per evaluation; the last value when the pair style has been replaced since. */
double FixPressWall::pressure_now() {
  Impl &my = *impl_;
  if (my.pressure_step == update->ntimestep || !attached()) return my.pressure;
  my.observer->require_complete(name);
  my.pressure_step = update->ntimestep;
  my.pressure = -my.toward * my.now.force * force->nktv2p / area();
  MPI_Allreduce(MPI_IN_PLACE, &my.pressure, 1, MPI_DOUBLE, MPI_SUM, world);
  return my.pressure;
}

double FixPressWall::compute_scalar() { return impl_->averaged_pressure; }

double FixPressWall::compute_vector(int n) { return Impl::elements()[n].value(*this); }

void FixPressWall::write_restart(FILE *file) {
  Impl &my = *impl_;
  double sums[3] = {my.window.force, my.window.stiffness, my.window.damping};
  MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, world);
  my.window = PlateResponse();
  if (comm->me != 0) return;
  // as a continued run will have it: the run that goes on stays equal to it, bit by bit
  my.window = {sums[0], sums[1], sums[2]};
  grainscope::write_state(file, SavedPlate{my.toward, my.travel, my.velocity, my.base, my.averaged_pressure, my.inputs,
                                           my.clipped, my.window_steps, sums[0], sums[1], sums[2],
                                           static_cast<double>(my.settings.every), my.settings.interval,
                                           my.intervals.passed(), my.intervals.next()});
}

void FixPressWall::restart(char *buffer) {
  Impl &my = *impl_;
  const auto saved = grainscope::read_state<SavedPlate>(lmp, *this, "press/wall", buffer);
  if (my.settings.toward == 0.0) my.toward = saved.toward;
  my.travel = saved.travel;
  my.velocity = saved.velocity;
  if (my.settings.base) my.base = saved.base;
  my.averaged_pressure = saved.averaged_pressure;
  my.inputs = saved.inputs;
  my.clipped = saved.clipped;
  my.window_steps = saved.window_steps;
  if (comm->me == 0) my.window = {saved.window_force, saved.window_stiffness, saved.window_damping};
  // If inputs are counted in another way than before, they begin again, with one at the first step.
  if (static_cast<double>(my.settings.every) == saved.every && my.settings.interval == saved.interval)
    my.intervals.restore(saved.passed, saved.next);
}

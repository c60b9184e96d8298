// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_displacement_shear.h"
#include "arguments.h"
#include "bodies.h"
#include "box_state.h"
#include "fix_grain_record.h"
#include "grain_shape.h"
#include "scope.h"
#include "strain_source.h"
#include "unwrapped_box.h"
#include "requirements.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_deform.h"
#include "group.h"
#include "modify.h"
#include "update.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

using namespace LAMMPS_NS;
using grainscope::Fluctuations;
using Kind = grainscope::MeanFlow::Kind;
using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

const char *const name = "compute displacement/shear";
constexpr auto intensive = grainscope::Extent::intensive, whole = grainscope::Extent::whole;

/** `time`: instead of strain. */
grainscope::Outputs declared(bool time) {
  grainscope::Outputs outputs;
  outputs.vector.add({"strain", time ? "time" : "-", intensive, "strain since the start"})
      .add_each("x y z", {"d2_*", "distance^2", intensive, "<d_*^2>, mean square displacement"})
      .add_each("x y z",
                {"D_*", time ? "distance^2/time" : "distance^2", intensive, "half the slope of <d_*^2> over strain"})
      .add({"N", "-", whole, "grains followed"})
      .add({"N_start", "-", whole, "grains followed at the start"})
      .add({"N_other", "-", whole, "grains of the group that are not followed"});
  outputs.scalar = {outputs.vector[2]};
  return outputs;
}

/** The memory of a grain: X of the last call, d, and whether it existed at the start. */
enum { POSITION = 0, DISPLACEMENT = 3, TRACKED = 6, WIDTH };

/** What all ranks share: whether it has started, strain at the start and at the last call, that call's time, step and
 *  box, and the sums of the fit: calls, strain, strain^2, and for x, y, z <d^2> and strain <d^2>; then the last means
 *  and the number of grains, at the start too, and of those of the group that are not followed. */
enum {
  STARTED = 0,
  STRAIN_0,
  STRAIN_1,
  TIME_1,
  STEP,
  EDGES,
  CALLS = EDGES + 9,
  STRAIN,
  STRAIN_STRAIN,
  SQUARE,
  STRAIN_SQUARE = SQUARE + 3,
  MEAN = STRAIN_SQUARE + 3,
  GRAINS = MEAN + 3,
  GRAINS_0,
  OTHERS,
  SHARED
};

const int no_remap = 0;  // of the host's numbers for none x v

/** Mean flows that include the box's own flow. */
bool moves_with_box(Kind flow) {
  return flow == Kind::none || flow == Kind::rate || flow == Kind::fit || flow == Kind::gradient;
}

}

struct ComputeDisplacementShear::Impl {
  explicit Impl(LAMMPS *lmp) : strain(lmp, name), scope(lmp, name, grainscope::Scope::region) {}
  grainscope::StrainSource strain;
  grainscope::Scope scope;
  grainscope::MeanFlow flow;
  double start = 0.0;
  FixGrainRecord *record = nullptr;

  double *shared() { return record->shared().data(); }
  void make_record(LAMMPS *lmp, const char *id, int igroup) {
    std::string meaning = std::string(name) + (strain.is_time() ? " time " : " ") + lmp->group->names[igroup];
    if (flow.kind != grainscope::MeanFlow::Kind::box) meaning += " flow " + flow.text();
    if (scope.within()) meaning += " region " + scope.within()->id();
    record = FixGrainRecord::make(lmp, id, igroup, WIDTH, SHARED, meaning, STEP);
  }
};

ComputeDisplacementShear::ComputeDisplacementShear(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : Compute(lmp, iarg, narg, arg), impl_(new Impl(lmp)) {
  grainscope::Arguments arguments(lmp, name, iarg, narg, arg);
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword(impl_->scope.with({"start", "strain", "flow", "plane"}));
    impl_->scope.read(arguments, keyword);
    if (keyword == "start") impl_->start = arguments.number(keyword, "a strain", [](double) { return true; });
    if (keyword == "strain") impl_->strain.read(arguments);
    if (keyword == "flow") impl_->flow.read(arguments);
    if (keyword == "plane") impl_->flow.plane.read(arguments);
  }
  grainscope::require_box(lmp, arguments);
  declare(this, declared(impl_->strain.is_time()));
  impl_->make_record(lmp, id, igroup);
}

ComputeDisplacementShear::~ComputeDisplacementShear() { FixGrainRecord::forget(lmp, id); }

void ComputeDisplacementShear::init() {
  impl_->strain.init();
  impl_->scope.init();
  impl_->record = FixGrainRecord::find(lmp, id);
  grainscope::Bodies(lmp, name).require_lasting();
  require_flow_of_all();
}

/** The grains of the group must move with the faces that fix deform moves. Collective. */
void ComputeDisplacementShear::require_flow_of_all() {
  for (int k = 0; k < modify->nfix; k++) {
    const FixDeform *deform = dynamic_cast<FixDeform *>(modify->fix[k]);
    if (!deform) continue;
    const std::string which = std::string("fix ") + deform->id + " (" + deform->style + ")";
    const grainscope::Arguments errors(lmp, name);
    if (deform->remapflag == no_remap)
      errors.fail(which + " must move grains along with the box, 'remap v' or 'remap x', got 'remap none': "
                          "displacements relative to its flow would be wrong");
    int others = 0;
    for (int i = 0; i < atom->nlocal && !others; i++)
      others = atom->mask[i] & groupbit && !(atom->mask[i] & deform->groupbit);
    MPI_Allreduce(MPI_IN_PLACE, &others, 1, MPI_INT, MPI_MAX, world);
    if (others)
      errors.fail(which + " must move all grains of group '" + group->names[igroup] + "', got group '" +
                  group->names[deform->igroup] + "'");
  }
}

/** Collective. */
grainscope::Bodies ComputeDisplacementShear::bodies_now() const {
  grainscope::Bodies bodies(lmp, name);
  bodies.update(grainscope::BoxState(lmp), groupbit);
  return bodies;
}

void ComputeDisplacementShear::begin(double strain) {
  const grainscope::UnwrappedBox box(*domain, *impl_->record);
  const grainscope::Bodies bodies = bodies_now();
  impl_->scope.update(grainscope::BoxState(lmp));
  double grains = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    double *record = impl_->record->of(i);
    std::fill(record, record + WIDTH, 0.0);
    if (!has(i, bodies)) continue;
    Map<Vector3d>(record + POSITION) = box.position(*atom, i, bodies);
    record[TRACKED] = 1.0;
    grains += 1.0;
  }
  MPI_Allreduce(MPI_IN_PLACE, &grains, 1, MPI_DOUBLE, MPI_SUM, world);
  double *shared = impl_->shared();
  std::fill(shared, shared + SHARED, 0.0);
  double forgotten[3];
  impl_->record->take_box_flips(forgotten);
  shared[STARTED] = 1.0;
  shared[STRAIN_0] = shared[STRAIN_1] = strain;
  shared[TIME_1] = impl_->record->passed_time();
  shared[GRAINS] = shared[GRAINS_0] = grains;
  if (grains == 0.0 && comm->me == 0) {
    const std::string in_region = impl_->scope.within() ? " and region '" + impl_->scope.within()->id() + "'" : "";
    error->warning(FLERR, (std::string(name) + " " + id + ": there is no grain in group '" + group->names[igroup] +
                           "'" + in_region + " at its start, and it follows only grains that are present then")
                              .c_str());
  }
  Map<Matrix3d>(shared + EDGES) = box.edges;
}

/** Grain i is on its own or stands for its clump, is in the group and, where one is given, in the region. */
bool ComputeDisplacementShear::has(int i, const grainscope::Bodies &bodies) const {
  if (!(atom->mask[i] & groupbit) || !bodies.stands_for_itself_or_clump(i)) return false;
  return impl_->scope.has_place(centre(i, bodies));
}

Vector3d ComputeDisplacementShear::centre(int i, const grainscope::Bodies &bodies) const {
  const grainscope::Body *body = bodies.of(i);
  return body ? body->centre : Vector3d(Map<const Vector3d>(atom->x[i]));
}

/** Advances the displacement of every grain to the present. */
void ComputeDisplacementShear::advance() {
  const grainscope::UnwrappedBox box(*domain, *impl_->record);
  const grainscope::Bodies bodies = bodies_now();
  double *shared = impl_->shared();
  Matrix3d before = Map<Matrix3d>(shared + EDGES);
  Matrix3d after = box.edges;
  double flips[3];
  impl_->record->take_box_flips(flips);
  after.col(2) -= flips[0] * after.col(1) + flips[1] * after.col(0);  // edges as if the box had not flipped
  after.col(1) -= flips[2] * after.col(0);
  for (int k = 0; k < 3; k++)
    if (box.follows_grains[k]) before.col(k) = after.col(k);

  const Matrix3d to_s1 = before.inverse(), to_s2 = after.inverse(), mean = 0.5 * (before + after);
  const double turn = 2.0 * IMGMAX;  // the host's image flags count modulo this
  const grainscope::MeanFlow &flow = impl_->flow;
  std::vector<Fluctuations::Grain> moved;
  std::vector<Vector3d> places(flow.kind == Kind::box ? 0 : atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++) {
    double *record = impl_->record->of(i);
    if (record[TRACKED] == 0.0) continue;
    const Vector3d now = box.position(*atom, i, bodies);
    Map<Vector3d> last(record + POSITION), d(record + DISPLACEMENT);
    const Vector3d s2 = to_s2 * (now - box.middle), s1 = to_s1 * (last - box.middle);
    Vector3d ds = s2 - s1;
    for (int k = 0; k < 3; k++)
      if (!box.follows_grains[k]) ds[k] = std::remainder(ds[k], turn);
    last = now;
    if (flow.kind == Kind::box) {
      d += mean * ds;
      continue;
    }
    Vector3d s = s2 - 0.5 * ds;  // half way, in the box
    for (int k = 0; k < 3; k++)
      if (domain->periodicity[k]) s[k] -= std::round(s[k]);
    Vector3d u = mean * ds;
    if (moves_with_box(flow.kind)) u += (after - before) * s;
    places[i] = after * s + box.middle + box.rest;
    const grainscope::Body *body = bodies.of(i);
    moved.push_back({i, 0, body ? body->mass : grainscope::mass_of(*atom, i), u, nullptr});
  }
  if (flow.kind != Kind::box) subtract_mean(std::move(moved), std::move(places));
  Map<Matrix3d>(shared + EDGES) = box.edges;
  shared[TIME_1] = impl_->record->passed_time();
}

/** Adds the displacement of the grains relative to their mean flow. */
void ComputeDisplacementShear::subtract_mean(std::vector<Fluctuations::Grain> moved, std::vector<Vector3d> places) {
  grainscope::MeanFlow flow = impl_->flow;
  flow.rate *= impl_->record->passed_time() - impl_->shared()[TIME_1];
  const Fluctuations motion(lmp, name, std::move(moved), std::move(places), grainscope::BoxState(lmp), flow);
  for (const Fluctuations::Grain &g : motion.local())
    Map<Vector3d>(impl_->record->of(g.index) + DISPLACEMENT) += motion.velocity(g);
}

/** A grain that has left the region is no longer followed. */
void ComputeDisplacementShear::forget_those_outside() {
  if (!impl_->scope.within()) return;
  impl_->scope.update(grainscope::BoxState(lmp));
  const grainscope::Bodies bodies = bodies_now();
  for (int i = 0; i < atom->nlocal; i++)
    if (!impl_->scope.has_place(centre(i, bodies))) impl_->record->of(i)[TRACKED] = 0.0;
}

void ComputeDisplacementShear::follow(double strain) {
  advance();
  forget_those_outside();
  double *shared = impl_->shared();
  const grainscope::Bodies bodies = bodies_now();
  double sums[5] = {};  // squares, grains that are followed, others of the group
  for (int i = 0; i < atom->nlocal; i++) {
    const double *record = impl_->record->of(i);
    if (record[TRACKED] == 0.0) {
      if (has(i, bodies)) sums[4] += 1.0;
      continue;
    }
    Map<Vector3d>(sums + 0) += Map<const Vector3d>(record + DISPLACEMENT).cwiseAbs2();
    sums[3] += 1.0;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 5, MPI_DOUBLE, MPI_SUM, world);
  for (int k = 0; k < 3; k++) shared[MEAN + k] = sums[3] > 0.0 ? sums[k] / sums[3] : 0.0;
  shared[GRAINS] = sums[3];
  shared[OTHERS] = sums[4];
  shared[STRAIN_1] = strain;
}

void ComputeDisplacementShear::before_change_box() {
  impl_->record = FixGrainRecord::find(lmp, id);
  if (impl_->shared()[STARTED] != 0.0) advance();
}

/** With `remap` grains moved affinely, without it they stayed: in both cases their displacement does not change. */
void ComputeDisplacementShear::after_change_box() {
  impl_->record = FixGrainRecord::find(lmp, id);
  impl_->record->note_changed_box();
  const grainscope::UnwrappedBox box(*domain, *impl_->record);
  const grainscope::Bodies bodies = bodies_now();
  for (int i = 0; i < atom->nlocal; i++) {
    double *record = impl_->record->of(i);
    if (record[TRACKED] != 0.0) Map<Vector3d>(record + POSITION) = box.position(*atom, i, bodies);
  }
  if (impl_->shared()[STARTED] != 0.0) Map<Matrix3d>(impl_->shared() + EDGES) = box.edges;
}

/** A point of the least squares. */
void ComputeDisplacementShear::measure(double strain) {
  double *shared = impl_->shared();
  if (shared[STARTED] == 0.0) begin(strain);
  else follow(strain);
  shared[STEP] = update->ntimestep;
  const double since = strain - shared[STRAIN_0];
  shared[CALLS] += 1.0;
  shared[STRAIN] += since;
  shared[STRAIN_STRAIN] += since * since;
  for (int k = 0; k < 3; k++) {
    shared[SQUARE + k] += shared[MEAN + k];
    shared[STRAIN_SQUARE + k] += since * shared[MEAN + k];
  }
}

void ComputeDisplacementShear::compute_vector() {
  invoked_vector = update->ntimestep;
  const double strain = impl_->strain.now(impl_->record->passed_time());
  double *shared = impl_->shared();
  const bool started = shared[STARTED] != 0.0;
  if (started ? shared[STEP] != update->ntimestep : std::fabs(strain) >= std::fabs(impl_->start) - 1e-9)
    measure(strain);

  std::fill(vector, vector + size_vector, 0.0);
  scalar = 0.0;
  if (shared[STARTED] == 0.0) return;
  const double n = shared[CALLS], spread = n * shared[STRAIN_STRAIN] - shared[STRAIN] * shared[STRAIN];
  double slopes[3] = {0.0, 0.0, 0.0};
  for (int k = 0; k < 3 && spread > 0.0; k++)
    slopes[k] = 0.5 * (n * shared[STRAIN_SQUARE + k] - shared[STRAIN] * shared[SQUARE + k]) / spread;
  const double *d2 = shared + MEAN;
  put_vector({shared[STRAIN_1] - shared[STRAIN_0], d2[0], d2[1], d2[2], slopes[0], slopes[1], slopes[2], shared[GRAINS],
              shared[GRAINS_0], shared[OTHERS]});
  scalar = d2[1];
}

double ComputeDisplacementShear::compute_scalar() {
  invoked_scalar = update->ntimestep;
  if (invoked_vector != update->ntimestep) compute_vector();
  return scalar;
}

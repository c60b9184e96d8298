// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_displacement_shear.h"
#include "arguments.h"
#include "bodies.h"
#include "box_state.h"
#include "fix_grain_record.h"
#include "strain_source.h"
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

using namespace LAMMPS_NS;
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

/** What is kept of a grain: X of the last call, d, and whether it was there at the start. */
enum { POSITION = 0, DISPLACEMENT = 3, TRACKED = 6, WIDTH };

/** What all ranks share: whether it has started, strain at the start and at the last call, that call's step and box,
 *  and the sums of the fit: calls, strain, strain^2, and for x, y, z <d^2> and strain <d^2>; then the last means and
 *  the number of grains, at the start too, and of those of the group that are not followed. */
enum {
  STARTED = 0,
  STRAIN_0,
  STRAIN_1,
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

const int no_remap = 0;          // of the host's numbers for none x v
const int last_that_stands = 1;  // of the host's numbers for p f s m

/** The box now, and where grains are in it. */
struct Box {
  Box(const Domain &domain, const FixGrainRecord &record)
      : edges(grainscope::upper_triangular(domain.h)), wrapped(grainscope::upper_triangular(record.edges())) {
    // The point that the flow leaves at rest: middle heights, and along the flow a place that does not follow the tilt.
    rest = Map<const Vector3d>(domain.boxlo) + 0.5 * edges.diagonal();
    for (int k = 0; k < 3; k++) {
      follows_grains[k] = domain.boundary[k][0] > last_that_stands || domain.boundary[k][1] > last_that_stands;
      if (!follows_grains[k]) continue;
      edges.col(k) /= edges(k, k);
      middle[k] = rest[k];
      rest[k] = 0.0;
    }
  }
  /** Position of grain i, or of its clump, from the point at rest (from 0 across faces that follow the grains), unwrapped
   *  with the edges that its image flags count. */
  Vector3d position(const Atom &atom, int i, const grainscope::Bodies &bodies) const {
    if (const grainscope::Body *body = bodies.of(i)) return body->centre + wrapped * body->boxes - rest;
    const tagint image = atom.image[i];
    const Vector3d boxes((image & IMGMASK) - IMGMAX, (image >> IMGBITS & IMGMASK) - IMGMAX,
                         (image >> IMG2BITS) - IMGMAX);
    return Map<const Vector3d>(atom.x[i]) + wrapped * boxes - rest;
  }

  Matrix3d edges, wrapped;
  Vector3d rest;
  bool follows_grains[3];              // faces across this edge move with the outermost grain, and no other with them
  Vector3d middle = Vector3d::Zero();  // of such edges now
};

}

struct ComputeDisplacementShear::Impl {
  explicit Impl(LAMMPS *lmp) : strain(lmp, name) {}
  grainscope::StrainSource strain;
  double start = 0.0;
  FixGrainRecord *record = nullptr;

  double *shared() { return record->shared().data(); }
};

ComputeDisplacementShear::ComputeDisplacementShear(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : Compute(lmp, iarg, narg, arg), impl_(new Impl(lmp)) {
  grainscope::Arguments arguments(lmp, name, iarg, narg, arg);
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword({"start", "strain"});
    if (keyword == "start") impl_->start = arguments.number(keyword, "a strain", [](double) { return true; });
    if (keyword == "strain") impl_->strain.read(arguments);
  }
  grainscope::require_box(lmp, arguments);
  declare(this, declared(impl_->strain.is_time()));
  impl_->record =
      FixGrainRecord::make(lmp, id, igroup, WIDTH, SHARED,
                           std::string(name) + (impl_->strain.is_time() ? " time " : " ") + group->names[igroup], STEP);
}

ComputeDisplacementShear::~ComputeDisplacementShear() { FixGrainRecord::forget(lmp, id); }

void ComputeDisplacementShear::init() {
  impl_->strain.init();
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
                          "displacements against its flow would be wrong");
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
  const Box box(*domain, *impl_->record);
  const grainscope::Bodies bodies = bodies_now();
  double grains = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    double *record = impl_->record->of(i);
    std::fill(record, record + WIDTH, 0.0);
    if (!(atom->mask[i] & groupbit) || !bodies.stands_for_itself_or_clump(i)) continue;
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
  shared[GRAINS] = shared[GRAINS_0] = grains;
  if (grains == 0.0 && comm->me == 0)
    error->warning(FLERR, (std::string(name) + " " + id + ": there is no grain in group '" + group->names[igroup] +
                           "' when it starts, and it follows those that are there then")
                              .c_str());
  Map<Matrix3d>(shared + EDGES) = box.edges;
}

/** Carries every grain's displacement on to now. */
void ComputeDisplacementShear::advance() {
  const Box box(*domain, *impl_->record);
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
  for (int i = 0; i < atom->nlocal; i++) {
    double *record = impl_->record->of(i);
    if (record[TRACKED] == 0.0) continue;
    const Vector3d now = box.position(*atom, i, bodies);
    Map<Vector3d> last(record + POSITION), d(record + DISPLACEMENT);
    Vector3d ds = to_s2 * (now - box.middle) - to_s1 * (last - box.middle);
    for (int k = 0; k < 3; k++)
      if (!box.follows_grains[k]) ds[k] = std::remainder(ds[k], turn);
    d += mean * ds;
    last = now;
  }
  Map<Matrix3d>(shared + EDGES) = box.edges;
}

void ComputeDisplacementShear::follow(double strain) {
  advance();
  double *shared = impl_->shared();
  const grainscope::Bodies bodies = bodies_now();
  double sums[5] = {};  // squares, grains that are followed, others of the group
  for (int i = 0; i < atom->nlocal; i++) {
    const double *record = impl_->record->of(i);
    if (record[TRACKED] == 0.0) {
      if ((atom->mask[i] & groupbit) && bodies.stands_for_itself_or_clump(i)) sums[4] += 1.0;
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

/** With `remap` grains moved affinely, without they stayed: in neither case do they come any farther. */
void ComputeDisplacementShear::after_change_box() {
  impl_->record = FixGrainRecord::find(lmp, id);
  impl_->record->note_changed_box();
  const Box box(*domain, *impl_->record);
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

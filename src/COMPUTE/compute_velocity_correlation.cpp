// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_velocity_correlation.h"
#include "arguments.h"
#include "decay_fit.h"
#include "fix_grain_record.h"
#include "fluctuations.h"
#include "gather_points.h"
#include "grain_shape.h"
#include "mesh_correlation.h"
#include "require_finite.h"
#include "requirements.h"
#include "scope.h"
#include "velocity_component.h"
#include "comm.h"
#include "domain.h"
#include "group.h"
#include "modify.h"
#include "update.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

using namespace LAMMPS_NS;
using grainscope::Arguments;
using grainscope::DistanceBins;
using grainscope::Fluctuations;
using grainscope::PairSums;
using grainscope::PeriodicCell;
using grainscope::PointValues;

namespace {

const char *const name = "compute velocity/correlation";
const double most_mesh_cells = 1e9;
constexpr auto intensive = grainscope::Extent::intensive, whole = grainscope::Extent::whole;

grainscope::Outputs declared(int bins) {
  const char *const square = "(velocity or 1/time)^2";
  grainscope::Outputs outputs;
  outputs.vector = {{"l", "distance", intensive, "correlation length, of the fit exp(-r/l)"},
                    {"l_error", "distance", intensive, "standard error of l, 0 for less than two bins"},
                    {"dv2", square, intensive, "<dv^2>"},
                    {"N", "-", whole, "grains; with 'average running' summed over calls"},
                    {"bins", "-", intensive, "bins in the fit"}};
  outputs.scalar = {outputs.vector.front()};
  outputs.set_array(bins, "bin of r",
                    {{"r", "distance", intensive, "middle of the bin"},
                     {"C", "-", intensive, "correlation at r"},
                     {"products", square, whole, "sum over pairs of dv_i dv_j"},
                     {"pairs", "-", whole, "pairs, each once"}});
  return outputs;
}

bool is_positive(double x) { return x > 0.0; }

double half_smallest_height(const PeriodicCell &cell) {
  return 0.5 * std::min({cell.height(0), cell.height(1), cell.height(2)});
}

}

struct ComputeVelocityCorrelation::Impl {
  /** Over ranks; with `average running` over calls too. */
  struct Totals {
    PairSums sums{0};
    double squares = 0.0, grains = 0.0, range = 0.0, calls = 0.0;

    void add(const Totals &other) {
      for (std::size_t k = 0; k < sums.pairs.size(); k++) {
        sums.products[0][k] += other.sums.products[0][k];
        sums.pairs[k] += other.sums.pairs[k];
      }
      squares += other.squares;
      grains += other.grains;
      range += other.range;
      calls += other.calls;
    }
  };

  /** The result that the search of another compute found for this one, in case it is requested. */
  struct Foreseen {
    bigint step = -1;
    PeriodicCell cell;
    PointValues points;
    PairSums share{0};  // of this rank
  };

  explicit Impl(LAMMPS *lmp) : scope(lmp, name, grainscope::Scope::region) {}
  grainscope::VelocityComponent component;
  int bins = 19;
  double range = 0.0;  // 0: half the smallest height of the box
  int mesh_per_bin = 4;
  bool running = false;
  grainscope::MeanFlow flow;
  grainscope::Scope scope;
  std::unique_ptr<grainscope::MeshCorrelation> mesh;  // of method mesh
  bigint measured = -1;                               // the step of the last measurement
  Totals totals;
  FixGrainRecord *record = nullptr;  // of `average running`: the totals, which restart files hold
  double bytes = 0.0;
  Foreseen foreseen;

  /** The numbers that the ranks share in the record: the step of the last call, four sums, then products and pairs of
   *  each bin. */
  enum { STEP, SQUARES, GRAINS, RANGE, CALLS, SUMS };
  void make_record(LAMMPS *lmp, const char *id, int igroup);
  bool counted(bigint step) const;
  Totals recorded() const;
  void add_to_record(const Totals &now, bigint step);

  bool looks_for_the_pairs_of(const Impl &other) const;
  std::vector<Impl *> asked_with(const ComputeVelocityCorrelation &one) const;
  Totals measure(const ComputeVelocityCorrelation &one);
  bool foresaw(LAMMPS *lmp, const PeriodicCell &cell, const PointValues &points) const;
  void require_finite(LAMMPS *lmp, const PointValues &points) const;
  PairSums share_of_pairs(LAMMPS *lmp, const PeriodicCell &cell, const PointValues &points,
                          const DistanceBins &distances);
};

ComputeVelocityCorrelation::ComputeVelocityCorrelation(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : Compute(lmp, iarg, narg, arg), impl_(new Impl(lmp)) {
  timeflag = 1;  // steps on which it will be asked are announced
  Arguments arguments(lmp, name, iarg, narg, arg);
  bool mesh_given = false;
  while (!arguments.done()) {
    const std::string keyword = arguments.keyword(
        impl_->scope.with({"component", "bins", "range", "method", "mesh", "flow", "plane", "average"}));
    impl_->scope.read(arguments, keyword);
    if (keyword == "component") impl_->component.read(arguments);
    if (keyword == "bins") impl_->bins = arguments.whole_number(keyword, 1, 10000);
    if (keyword == "range") impl_->range = arguments.number(keyword, "a positive length", is_positive);
    if (keyword == "method") {
      const bool by_mesh = arguments.choice(keyword, {"direct", "mesh"}) == "mesh";
      impl_->mesh = by_mesh ? grainscope::MeshCorrelation::make(world) : nullptr;
      if (by_mesh && !impl_->mesh)
        arguments.fail("'method' must be direct in a program that was built without FFTW, got 'mesh'");
    }
    if (keyword == "mesh") {
      mesh_given = true;
      impl_->mesh_per_bin = arguments.whole_number(keyword, 1, 100);
    }
    if (keyword == "flow") impl_->flow.read(arguments);
    if (keyword == "plane") impl_->flow.plane.read(arguments);
    if (keyword == "average") impl_->running = arguments.choice(keyword, {"one", "running"}) == "running";
  }
  if (mesh_given && !impl_->mesh) arguments.fail("'mesh' needs 'method mesh'");
  grainscope::require_grains(lmp, arguments);
  if (impl_->running) {
    grainscope::require_box(lmp, arguments);
    impl_->make_record(lmp, id, igroup);
  }
  declare(this, declared(impl_->bins));
}

ComputeVelocityCorrelation::~ComputeVelocityCorrelation() {
  if (impl_->running) FixGrainRecord::forget(lmp, id);
}

void ComputeVelocityCorrelation::Impl::make_record(LAMMPS *lmp, const char *id, int igroup) {
  std::ostringstream meaning;
  meaning.precision(17);
  meaning << name << ' ' << lmp->group->names[igroup] << ' ' << component.spin << component.axis << ' ' << bins << ' '
          << range << ' ' << (mesh ? mesh_per_bin : 0) << ' ' << flow.text();
  if (scope.within()) meaning << ' ' << scope.within()->id();
  record = FixGrainRecord::make(lmp, id, igroup, 1, SUMS + 2 * bins, meaning.str(), STEP);
}

bool ComputeVelocityCorrelation::Impl::counted(bigint step) const {
  const std::vector<double> &shared = record->shared();
  return shared[CALLS] > 0.0 && shared[STEP] == step;
}

ComputeVelocityCorrelation::Impl::Totals ComputeVelocityCorrelation::Impl::recorded() const {
  const std::vector<double> &shared = record->shared();
  Totals before;
  before.sums = PairSums(bins);
  before.squares = shared[SQUARES];
  before.grains = shared[GRAINS];
  before.range = shared[RANGE];
  before.calls = shared[CALLS];
  std::copy_n(shared.begin() + SUMS, bins, before.sums.products[0].begin());
  std::copy_n(shared.begin() + SUMS + bins, bins, before.sums.pairs.begin());
  return before;
}

/** And makes the totals what is then there. */
void ComputeVelocityCorrelation::Impl::add_to_record(const Totals &now, bigint step) {
  std::vector<double> &shared = record->shared();
  totals = recorded();
  totals.add(now);
  const double numbers[SUMS] = {static_cast<double>(step), totals.squares, totals.grains, totals.range, totals.calls};
  std::copy(numbers, numbers + SUMS, shared.begin());
  std::copy_n(totals.sums.products[0].begin(), bins, shared.begin() + SUMS);
  std::copy_n(totals.sums.pairs.begin(), bins, shared.begin() + SUMS + bins);
}

void ComputeVelocityCorrelation::init() {
  const Arguments errors(lmp, name);
  grainscope::require_grains(lmp, errors);
  impl_->measured = -1;
  impl_->scope.init();
  grainscope::require_known_bodies(lmp, name);
  if (impl_->running) impl_->record = FixGrainRecord::find(lmp, id);
  if (impl_->mesh && !(domain->xperiodic && domain->yperiodic && domain->zperiodic))
    errors.fail("'method' must be direct in a box that is not periodic in all three directions, got 'mesh'");
}

/** This rank's share of the sums over pairs. */
PairSums ComputeVelocityCorrelation::Impl::share_of_pairs(LAMMPS *lmp, const PeriodicCell &cell,
                                                          const PointValues &points, const DistanceBins &distances) {
  if (!mesh) {
    const PointValues all = grainscope::gathered(points, lmp->world);
    bytes = (11.0 + all.sets()) * sizeof(double) * all.size();  // these, and a copy in the order of cells
    return grainscope::direct_pair_sums(cell, all, distances, lmp->comm->me, lmp->comm->nprocs);
  }
  std::array<int, 3> size;
  try {
    size = grainscope::mesh_size(cell, distances, mesh_per_bin, most_mesh_cells);
  } catch (const std::length_error &wanted) {
    Arguments(lmp, name).fail("'mesh' " + std::to_string(mesh_per_bin) + " must give fewer than 1e9 cells, got " +
                              wanted.what() +
                              ": use fewer bins or 'method direct', which is fast when the range is short");
  }
  PairSums sums = mesh->pair_sums(cell, points, distances, size);
  bytes = mesh->memory_usage();
  return sums;
}

/** Collective. */
void ComputeVelocityCorrelation::Impl::require_finite(LAMMPS *lmp, const PointValues &points) const {
  double strays = 0.0;
  for (std::size_t i = 0; i < points.size(); i++)
    strays += std::isfinite(points.s[0][i] + points.s[1][i] + points.s[2][i]) ? 0.0 : 1.0;
  MPI_Allreduce(MPI_IN_PLACE, &strays, 1, MPI_DOUBLE, MPI_SUM, lmp->world);
  grainscope::require_finite(lmp, name, strays, "the positions",
                             "grains are not finite: check what moves or pushes them");
}

/** Of the same group, but maybe of other components. */
bool ComputeVelocityCorrelation::Impl::looks_for_the_pairs_of(const Impl &other) const {
  return !mesh && !other.mesh && bins == other.bins && range == other.range && flow.text() == other.flow.text() &&
         scope.within() == other.scope.within();
}

/** The other computes that are requested in this step too and can share the search. */
std::vector<ComputeVelocityCorrelation::Impl *> ComputeVelocityCorrelation::Impl::asked_with(
    const ComputeVelocityCorrelation &one) const {
  std::vector<Impl *> found;
  const Modify &modify = *one.modify;
  for (int k = 0; k < modify.ncompute && found.size() + 1 < PointValues::MOST_SETS; k++) {
    auto *const other = dynamic_cast<ComputeVelocityCorrelation *>(modify.compute[k]);
    if (!other || other == &one || other->igroup != one.igroup || !looks_for_the_pairs_of(*other->impl_)) continue;
    if (other->impl_->measured != one.update->ntimestep && other->matchstep(one.update->ntimestep))
      found.push_back(other->impl_.get());
  }
  return found;
}

/** Whether these are, on all ranks, the points whose sums are there. */
bool ComputeVelocityCorrelation::Impl::foresaw(LAMMPS *lmp, const PeriodicCell &cell, const PointValues &points) const {
  if (foreseen.step != lmp->update->ntimestep) return false;
  int same = foreseen.cell.edges == cell.edges && foreseen.cell.periodic == cell.periodic &&
             foreseen.points.values == points.values;
  for (int k = 0; k < 3; k++) same = same && foreseen.points.s[k] == points.s[k];
  MPI_Allreduce(MPI_IN_PLACE, &same, 1, MPI_INT, MPI_MIN, lmp->world);
  return same;
}

ComputeVelocityCorrelation::Impl::Totals ComputeVelocityCorrelation::Impl::measure(
    const ComputeVelocityCorrelation &one) {
  LAMMPS *const lmp = one.lmp;
  const grainscope::BoxState box(lmp);
  const PeriodicCell cell = grainscope::periodic_cell(box);
  const DistanceBins distances{range > 0.0 ? range : half_smallest_height(cell), bins};
  scope.update(box);
  const Fluctuations motion(lmp, {name, one.groupbit, scope.within()}, box, flow);
  PointValues points;
  double smallest = std::numeric_limits<double>::infinity();
  Totals now;
  for (const Fluctuations::Grain &g : motion.local()) {
    const double value = component.of(motion, g);
    points.add(box.fraction(motion.place(g)), value);
    smallest = std::min(smallest, 2.0 * grainscope::semi_axes(*lmp->atom, g.index).minCoeff());
    now.squares += value * value;
  }
  require_finite(lmp, points);
  if (foresaw(lmp, cell, points)) {
    now.sums = std::move(foreseen.share);
  } else {
    const std::vector<Impl *> others = asked_with(one);
    for (const Impl *other : others) {
      points.values.emplace_back();
      for (const Fluctuations::Grain &g : motion.local())
        points.values.back().push_back(other->component.of(motion, g));
    }
    try {
      now.sums = share_of_pairs(lmp, cell, points, distances);
    } catch (const std::length_error &reason) {
      Arguments(lmp, name).fail(reason.what());
    }
    for (std::size_t n = 1; n <= others.size(); n++) {
      Foreseen &theirs = others[n - 1]->foreseen;
      theirs = {lmp->update->ntimestep, cell, points, now.sums};
      theirs.points.values = {points.values[n]};
      theirs.share.products = {now.sums.products[n]};
    }
  }
  foreseen = Foreseen();
  MPI_Allreduce(MPI_IN_PLACE, &smallest, 1, MPI_DOUBLE, MPI_MIN, lmp->world);
  MPI_Allreduce(MPI_IN_PLACE, &now.squares, 1, MPI_DOUBLE, MPI_SUM, lmp->world);
  now.sums.products.resize(1);
  MPI_Allreduce(MPI_IN_PLACE, now.sums.products[0].data(), bins, MPI_DOUBLE, MPI_SUM, lmp->world);
  MPI_Allreduce(MPI_IN_PLACE, now.sums.pairs.data(), bins, MPI_DOUBLE, MPI_SUM, lmp->world);
  for (int k = 0; k < bins && (k + 1) * distances.width() <= smallest; k++)
    now.sums.products[0][k] = now.sums.pairs[k] = 0.0;
  now.grains = motion.grains();
  now.range = distances.range;
  now.calls = 1.0;
  return now;
}

void ComputeVelocityCorrelation::measure() {
  Impl &all = *impl_;
  if (all.measured == update->ntimestep) return;
  all.measured = update->ntimestep;
  if (!all.running) all.totals = all.measure(*this);
  else if (all.counted(update->ntimestep)) all.totals = all.recorded();
  else all.add_to_record(all.measure(*this), update->ntimestep);
  report();
}

/** Rows, vector and scalar from the totals. */
void ComputeVelocityCorrelation::report() {
  Impl &all = *impl_;
  const Impl::Totals &t = all.totals;
  const DistanceBins distances{t.range / t.calls, all.bins};
  const double mean_square = t.grains > 0.0 ? t.squares / t.grains : 0.0;
  std::vector<double> r(all.bins), c(all.bins, 0.0);
  for (int k = 0; k < all.bins; k++) {
    r[k] = distances.middle(k);
    if (t.sums.pairs[k] > 0.0 && mean_square > 0.0) c[k] = t.sums.products[0][k] / t.sums.pairs[k] / mean_square;
    put_row(k, {r[k], c[k], t.sums.products[0][k], t.sums.pairs[k]});
  }
  const grainscope::DecayFit fit = grainscope::fit_decay(r, c);
  put_vector({fit.length, fit.error, mean_square, t.grains, static_cast<double>(fit.points)});
  scalar = fit.length;
}

void ComputeVelocityCorrelation::compute_array() {
  invoked_array = update->ntimestep;
  measure();
}

void ComputeVelocityCorrelation::compute_vector() {
  invoked_vector = update->ntimestep;
  measure();
}

double ComputeVelocityCorrelation::compute_scalar() {
  invoked_scalar = update->ntimestep;
  measure();
  return scalar;
}

double ComputeVelocityCorrelation::memory_usage() { return impl_->bytes + array_bytes(); }

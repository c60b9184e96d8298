// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_velocity_memory.h"
#include "arguments.h"
#include "bin_index.h"
#include "decay_fit.h"
#include "fix_grain_record.h"
#include "fluctuations.h"
#include "requirements.h"
#include "scope.h"
#include "strain_source.h"
#include "velocity_component.h"
#include "atom.h"
#include "comm.h"
#include "error.h"
#include "group.h"
#include "update.h"
#include <algorithm>
#include <cmath>
#include <sstream>

using namespace LAMMPS_NS;
using grainscope::Fluctuations;

namespace {

const char *const name = "compute velocity/memory";
constexpr auto intensive = grainscope::Extent::intensive, whole = grainscope::Extent::whole;

/** What all ranks share: number of samples, strain of the first, number of the next multiple, grains of the last
 *  sample and new ones among them; then the strains of the
 *  last `lags` samples (sample k at k modulo lags); then for each lag the sums of strains between samples, of products,
 *  and the number of products. */
enum { SAMPLES = 0, STRAIN_0, NEXT, NOW, NEW, PAST };
enum { STRAIN = 0, PRODUCTS, PAIRS, SUMS };

/** `unit`: of the strain, or time, that lags are measured in. */
grainscope::Outputs declared(int rows, const char *unit) {
  grainscope::Outputs outputs;
  outputs.vector = {{"g", unit, intensive, "strain of the fit exp(-lag/g)"},
                    {"g_error", unit, intensive, "standard error of g"},
                    {"samples", "-", intensive, "samples"},
                    {"lags", "-", intensive, "lags in the fit"},
                    {"N", "-", whole, "grains of the last sample"},
                    {"N_new", "-", whole, "of these, grains that the sample before did not have"}};
  outputs.scalar = {outputs.vector.front()};
  outputs.set_array(rows, "lag, from 0 on",
                    {{"lag", unit, intensive, "mean strain between the samples"},
                     {"C", "-", intensive, "correlation at the lag"},
                     {"products", "(velocity or 1/time)^2", whole, "sum of products"},
                     {"pairs", "-", whole, "number of products"}});
  return outputs;
}

}

struct ComputeVelocityMemory::Impl {
  explicit Impl(LAMMPS *lmp) : strain(lmp, name), scope(lmp, name, grainscope::Scope::region) {}
  grainscope::StrainSource strain;
  grainscope::Scope scope;
  grainscope::MeanFlow flow;
  grainscope::VelocityComponent component;
  double every = 0.01;
  int lags = 50;
  FixGrainRecord *record = nullptr;

  double *shared() { return record->shared().data(); }
  double *past() { return shared() + PAST; }
  double *sums(int lag) { return past() + lags + lag * SUMS; }
  /** Per grain: its values in the last samples, then 1 + the number of the first sample it was in. */
  void make_record(LAMMPS *lmp, const char *id, int igroup) {
    std::ostringstream meaning;
    meaning.precision(17);
    meaning << name << ' ' << lmp->group->names[igroup] << ' ' << component.spin << component.axis << ' ' << every
            << ' ' << lags << ' ' << flow.text();
    if (scope.within()) meaning << ' ' << scope.within()->id();
    if (strain.is_time()) meaning << " time";
    record = FixGrainRecord::make(lmp, id, igroup, lags + 1, PAST + lags + (lags + 1) * SUMS, meaning.str());
  }
};

ComputeVelocityMemory::ComputeVelocityMemory(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : Compute(lmp, iarg, narg, arg), impl_(new Impl(lmp)) {
  grainscope::Arguments arguments(lmp, name, iarg, narg, arg);
  while (!arguments.done()) {
    const std::string keyword =
        arguments.keyword(impl_->scope.with({"component", "every", "lags", "strain", "flow", "plane"}));
    impl_->scope.read(arguments, keyword);
    if (keyword == "component") impl_->component.read(arguments);
    if (keyword == "every")
      impl_->every = arguments.number(keyword, "a positive strain", [](double x) { return x > 0.0; });
    if (keyword == "lags") impl_->lags = arguments.whole_number(keyword, 1, 400);
    if (keyword == "strain") impl_->strain.read(arguments);
    if (keyword == "flow") impl_->flow.read(arguments);
    if (keyword == "plane") impl_->flow.plane.read(arguments);
  }
  grainscope::require_grains(lmp, arguments);
  grainscope::require_box(lmp, arguments);
  declare(this, declared(impl_->lags + 1, impl_->strain.is_time() ? "time" : "-"));
  impl_->make_record(lmp, id, igroup);
}

ComputeVelocityMemory::~ComputeVelocityMemory() { FixGrainRecord::forget(lmp, id); }

void ComputeVelocityMemory::init() {
  impl_->strain.init();
  impl_->scope.init();
  grainscope::Bodies(lmp, name).require_lasting();
  impl_->record = FixGrainRecord::find(lmp, id);
}

void ComputeVelocityMemory::sample_if_due() {
  double *shared = impl_->shared();
  const double strain = impl_->strain.now(impl_->record->passed_time());
  if (shared[SAMPLES] == 0.0) shared[STRAIN_0] = strain;
  // 1e-9: a strain that is a sum of steps errs by ulps.
  const double passed = std::fabs(strain - shared[STRAIN_0]) / impl_->every + 1e-9;
  if (passed < shared[NEXT]) return;
  shared[NEXT] = std::floor(passed) + 1.0;
  sample(strain);
}

/** A grain that is not in this sample counts from the next sample that it is in: it was not seen in between. */
void ComputeVelocityMemory::forget_others(const Fluctuations &motion) {
  std::vector<char> chosen(atom->nlocal, 0);
  for (const Fluctuations::Grain &g : motion.local()) chosen[g.index] = 1;
  for (int i = 0; i < atom->nlocal; i++)
    if (!chosen[i]) impl_->record->of(i)[impl_->lags] = 0.0;
}

void ComputeVelocityMemory::sample(double strain) {
  const int lags = impl_->lags;
  const long count = grainscope::whole_count(impl_->shared()[SAMPLES], 1e15);
  if (count < 0)
    grainscope::Arguments(lmp, name).fail("the number of samples in its memory is damaged, got " +
                                          grainscope::Arguments::text(impl_->shared()[SAMPLES]));
  const int known = std::min<long>(count, lags);   // lags that reach back to a sample
  std::vector<double> sums(2 * (known + 1), 0.0);  // products, pairs
  const grainscope::BoxState box(lmp);
  impl_->scope.update(box);
  const Fluctuations motion(lmp, {name, groupbit, impl_->scope.within()}, box, impl_->flow);
  forget_others(motion);
  double grains[2] = {static_cast<double>(motion.local().size()), 0.0};  // and new ones
  for (const Fluctuations::Grain &g : motion.local()) {
    double *past = impl_->record->of(g.index), &first = past[lags];
    if (first == 0.0) {
      first = count + 1;
      grains[1] += 1.0;
    }
    const double now = impl_->component.of(motion, g);
    sums[0] += now * now;
    sums[1] += 1.0;
    for (int lag = 1; lag <= known && count - lag >= first - 1.0; lag++) {
      sums[2 * lag] += now * past[(count - lag) % lags];
      sums[2 * lag + 1] += 1.0;
    }
    past[count % lags] = now;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), sums.size(), MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(MPI_IN_PLACE, grains, 2, MPI_DOUBLE, MPI_SUM, world);
  impl_->shared()[NOW] = grains[0];
  impl_->shared()[NEW] = grains[1];
  if (count == 0 && grains[0] == 0.0 && comm->me == 0)
    error->warning(FLERR, (std::string(name) + " " + id + ": there is no grain in the first sample").c_str());
  for (int lag = 0; lag <= known; lag++) {
    double *s = impl_->sums(lag);
    if (lag > 0) s[STRAIN] += strain - impl_->past()[(count - lag) % lags];
    s[PRODUCTS] += sums[2 * lag];
    s[PAIRS] += sums[2 * lag + 1];
  }
  impl_->past()[count % lags] = strain;
  impl_->shared()[SAMPLES] = count + 1;
}

void ComputeVelocityMemory::fill_array() {
  const double samples = impl_->shared()[SAMPLES];
  const double *zero = impl_->sums(0);
  const double square = zero[PAIRS] > 0.0 ? zero[PRODUCTS] / zero[PAIRS] : 0.0;
  for (int lag = 0; lag <= impl_->lags; lag++) {
    const double *s = impl_->sums(lag);
    const double strain = samples > lag ? s[STRAIN] / (samples - lag) : 0.0;
    const double c = s[PAIRS] > 0.0 && square > 0.0 ? s[PRODUCTS] / s[PAIRS] / square : 0.0;
    put_row(lag, {strain, c, s[PRODUCTS], s[PAIRS]});
  }
}

void ComputeVelocityMemory::compute_array() {
  invoked_array = update->ntimestep;
  sample_if_due();
  fill_array();
}

void ComputeVelocityMemory::compute_vector() {
  invoked_vector = update->ntimestep;
  compute_array();
  std::vector<double> lag, c;
  for (int k = 1; k <= impl_->lags; k++) {
    lag.push_back(std::fabs(array[k][0]));
    c.push_back(array[k][1]);
  }
  const grainscope::DecayFit fit = grainscope::fit_decay(lag, c);
  put_vector({fit.length, fit.error, impl_->shared()[SAMPLES], static_cast<double>(fit.points), impl_->shared()[NOW],
              impl_->shared()[NEW]});
  scalar = fit.length;
}

double ComputeVelocityMemory::compute_scalar() {
  invoked_scalar = update->ntimestep;
  if (invoked_vector != update->ntimestep) compute_vector();
  return scalar;
}

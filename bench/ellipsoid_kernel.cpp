// SPDX-License-Identifier: GPL-2.0-or-later
// Nanoseconds per pair of the ellipsoid kernel and of LIGGGHTS's superquadric routines, on the same pairs. Drawn as a
// chart by ellipsoid_chart.py; by hand: ellipsoid_kernel --benchmark_filter=warm --benchmark_repetitions=9
// --benchmark_report_aggregates_only=true
#include "side_by_side.h"
#include "superquadric_pair.h"
#include <benchmark/benchmark.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

extern double superquadric_tolerance;  // of LIGGGHTS's Newton iteration; see CMakeLists.txt

using namespace grainscope;

namespace {

constexpr int PAIRS = 500;
constexpr double DRIFT = 1e-4, OWN_TOLERANCE = 1e-10;
enum class Situation { touching, near_miss, rejected };
const char *const NAMES[] = {"touching", "near_miss", "rejected"};

struct Case {
  GrainPair pair;
  PairMotion motion;
  double start = 0.0;
  SuperquadricHistory history;
  reference::Contact exact;
};

/** What a pair was a step ago, when its grains were off by DRIFT times the smallest semi-axis, and turned by DRIFT. */
void remember(Case &c) {
  const GrainPair before = c.motion.before(c.pair);
  c.start = kernel_contact<Triaxial>(before).lambda;
  SuperquadricPair(before).contact(c.history);
}

/** Touching: centres 1e-5 to 1e-3 of their distance nearer than at tangency. The others: anywhere in the reach of a
 *  neighbour list, 1.05 times the sum of the longest semi-axes; near miss where LIGGGHTS's boxes overlap, rejected
 *  where they do not. */
std::vector<Case> draw(Situation wanted, double alpha, bool triaxial) {
  RandomPairs random(static_cast<unsigned long>(1000 * alpha));
  std::vector<Case> cases;
  while (cases.size() < PAIRS) {
    GrainPair pair;
    for (int k = 0; k < 2; k++) {
      random.spheroid(pair, k, alpha);
      if (triaxial) pair.semi[k][1] *= 1.3;
    }
    const double longest = *std::max_element(pair.semi[0], pair.semi[0] + 3), smallest = pair.smallest();
    if (wanted == Situation::touching) random.place(pair, random.logarithmic(1e-5, 1e-3));
    else {
      random.direction(pair.d, 3);
      const double distance = 2.1 * longest * std::cbrt(random.uniform());
      for (double &x : pair.d) x *= distance;
    }
    SuperquadricPair host(pair);
    SuperquadricHistory history;
    const bool touching = host.contact(history), far = history.state == SuperquadricHistory::FAR;
    const Situation is = touching ? Situation::touching : far ? Situation::rejected : Situation::near_miss;
    if (is != wanted) continue;
    cases.push_back({pair,
                     PairMotion(random, DRIFT * smallest, DRIFT),
                     0.0,
                     {},
                     reference::solve(pair.body(0), pair.body(1), pair.d)});
    remember(cases.back());
  }
  return cases;
}

const std::vector<Case> &cases_of(Situation situation, double alpha, bool triaxial) {
  static std::vector<std::pair<std::array<double, 3>, std::unique_ptr<std::vector<Case>>>> known;
  const std::array<double, 3> key = {static_cast<double>(situation), alpha, static_cast<double>(triaxial)};
  for (const auto &[k, cases] : known)
    if (k == key) return *cases;
  known.emplace_back(key, std::make_unique<std::vector<Case>>(draw(situation, alpha, triaxial)));
  return *known.back().second;
}

/** Seconds per pair, and the error of the contact point in smallest semi-axes. */
void report(benchmark::State &state, const std::vector<Case> &cases, const std::vector<std::array<double, 3>> &points,
            bool touching) {
  state.counters["pair"] =
      benchmark::Counter(PAIRS, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  if (!touching) return;
  double largest = 0.0, sum = 0.0;
  for (size_t n = 0; n < cases.size(); n++) {
    double square = 0.0;
    for (int k = 0; k < 3; k++) square += std::pow(static_cast<double>(points[n][k] - cases[n].exact.point[k]), 2);
    square /= std::pow(cases[n].pair.smallest(), 2);
    largest = std::max(largest, std::sqrt(square));
    sum += square;
  }
  state.counters["point_max"] = largest;
  state.counters["point_rms"] = std::sqrt(sum / cases.size());
}

template <class Body>
void kernel(benchmark::State &state, Situation situation, double alpha, bool triaxial, bool warm, double tolerance) {
  const std::vector<Case> &cases = cases_of(situation, alpha, triaxial);
  struct Ready {
    Body one, two;
    double d[3], start;
  };
  std::vector<Ready> ready(cases.size());
  for (size_t n = 0; n < cases.size(); n++) {
    make(cases[n].pair, 0, ready[n].one);
    make(cases[n].pair, 1, ready[n].two);
    std::copy_n(cases[n].pair.d, 3, ready[n].d);
    ready[n].start = warm ? cases[n].start : 0.0;
  }
  const auto run = [&](const Ready &r) {
    return tolerance > 0.0 ? ellipsoid_contact(r.one, r.two, r.d, r.start, tolerance)
                           : ellipsoid_contact(r.one, r.two, r.d, r.start);
  };
  for (auto _ : state)
    for (const Ready &r : ready) benchmark::DoNotOptimize(run(r));
  std::vector<std::array<double, 3>> points(cases.size());
  for (size_t n = 0; n < cases.size(); n++) {
    const EllipsoidContact c = run(ready[n]);
    std::copy_n(c.point, 3, points[n].begin());
  }
  report(state, cases, points, situation == Situation::touching);
}

/** Four pairs in one call. */
void side_by_side(benchmark::State &state, Situation situation, double alpha, bool triaxial, bool warm, double) {
  const std::vector<Case> &cases = cases_of(situation, alpha, triaxial);
  std::vector<SideBySide::Query> queries(cases.size());
  for (size_t n = 0; n < cases.size(); n++) {
    make(cases[n].pair, 0, queries[n].one);
    make(cases[n].pair, 1, queries[n].two);
    std::copy_n(cases[n].pair.d, 3, queries[n].d);
    queries[n].start = warm ? cases[n].start : 0.0;
  }
  SideBySide ready(queries);
  for (auto _ : state)
    ready.meet([](const PairGroup &, const GroupGeometry &geometry) {
      benchmark::DoNotOptimize(&geometry);
      benchmark::ClobberMemory();
    });
  const std::vector<EllipsoidContact> contacts = ready.contacts();
  std::vector<std::array<double, 3>> points(cases.size());
  for (size_t n = 0; n < cases.size(); n++) std::copy_n(contacts[n].point, 3, points[n].begin());
  report(state, cases, points, situation == Situation::touching);
}

void liggghts(benchmark::State &state, Situation situation, double alpha, bool triaxial, bool warm, double tolerance) {
  const std::vector<Case> &cases = cases_of(situation, alpha, triaxial);
  std::vector<std::unique_ptr<SuperquadricPair>> ready;
  std::vector<SuperquadricHistory> histories;
  for (const Case &c : cases) {
    ready.push_back(std::make_unique<SuperquadricPair>(c.pair, &c.motion));
    histories.push_back(warm ? c.history : SuperquadricHistory());
  }
  superquadric_tolerance = tolerance > 0.0 ? tolerance : OWN_TOLERANCE;
  for (auto _ : state)
    for (size_t n = 0; n < ready.size(); n++) {
      SuperquadricHistory history = histories[n];
      benchmark::DoNotOptimize(ready[n]->contact(history));
    }
  superquadric_tolerance = OWN_TOLERANCE;
  std::vector<std::array<double, 3>> points(cases.size());
  for (size_t n = 0; n < cases.size(); n++) std::copy_n(ready[n]->point, 3, points[n].begin());
  report(state, cases, points, situation == Situation::touching);
}

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

using Run = void (*)(benchmark::State &, Situation, double, bool, bool, double);

void add(const std::string &who, Run run, Situation situation, double alpha, bool triaxial, bool warm,
         double tolerance = 0.0) {
  std::string name =
      who + "/" + NAMES[static_cast<int>(situation)] + (warm ? "/warm" : "/cold") + "/alpha:" + number(alpha);
  if (tolerance > 0.0) name += "/tolerance:" + number(tolerance);
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State &state) {
    run(state, situation, alpha, triaxial, warm, tolerance);
  })->MinTime(0.05);
}

}

int main(int argc, char **argv) {
  for (double alpha : {0.05, 0.33, 0.67, 1.0, 1.5, 3.0, 20.0})
    for (Situation situation : {Situation::touching, Situation::near_miss, Situation::rejected})
      for (bool warm : {true, false}) {
        add("liggghts", liggghts, situation, alpha, false, warm);
        add("spheroids", kernel<Spheroid>, situation, alpha, false, warm);
        add("side_by_side", side_by_side, situation, alpha, false, warm);
        add("triaxial", kernel<Triaxial>, situation, alpha, true, warm);
      }
  for (double alpha : {0.33, 1.5, 3.0}) {
    for (double tolerance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-13, 1e-16, 1e-20, 1e-24})
      add("liggghts", liggghts, Situation::touching, alpha, false, true, tolerance);
    for (double tolerance : {1e-1, 1e-2, 1e-3, 1e-4, 3e-5, 1e-5, 1e-6, 1e-8})
      add("spheroids", kernel<Spheroid>, Situation::touching, alpha, false, true, tolerance);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}

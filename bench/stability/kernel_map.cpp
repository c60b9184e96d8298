// SPDX-License-Identifier: GPL-2.0-or-later
// Where LIGGGHTS's superquadric routines and the ellipsoid kernel fail, and how exact they are, over aspect ratio and
// overlap: CSV on standard output, progress on standard error. Drawn by kernel_map.py.
// Usage: kernel_map [pairs per cell, default 200]
#include "superquadric_pair.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace grainscope;
using reference::Quad;

namespace {

constexpr double DRIFT = 1e-4;  // of a step, in smallest semi-axes and as an angle
// an error beyond which the answer is a wrong one: point and overlap in smallest semi-axes, normal in rad
constexpr double GROSS = 1e-2;

/** Aligned: axes parallel, one grain on the other along the shortest axis and up to 0.3 of the longest one aside. */
enum class Posture { random, aligned };
/** What is given: the overlap, or the distance of the centres; both in smallest semi-axes. */
enum class Given { overlap, distance };

struct Answer {
  bool failed = false;  // the iteration says so
  bool touching = false;
  double point[3], normal[3], overlap = 0.0;

  bool finite() const {
    double sum = overlap;
    for (int k = 0; k < 3; k++) sum += std::fabs(point[k]) + std::fabs(normal[k]);
    return std::isfinite(sum);
  }
};

/** What a cell of the map counts, and the largest errors of the answers that are finite and not called failed.
 *  Concentric grains have no exact answer: they are counted only. */
struct Tally {
  long pairs = 0, failed = 0, not_finite = 0, missed = 0, invented = 0, gross = 0;
  double point = 0.0, normal = 0.0, overlap = 0.0;  // the largest

  void add(const Answer &answer, const reference::Contact &exact, double smallest) {
    pairs++;
    failed += answer.failed;
    missed += !answer.touching;
    not_finite += answer.touching && !answer.finite();
    if (!exact.proved || answer.failed || !answer.touching || !answer.finite()) return;
    const double errors[] = {distance(answer.point, exact.point) / smallest, distance(answer.normal, exact.normal),
                             std::fabs(static_cast<double>(answer.overlap - exact.depth[0] - exact.depth[1])) /
                                 smallest};
    point = std::max(point, errors[0]);
    normal = std::max(normal, errors[1]);
    overlap = std::max(overlap, errors[2]);
    gross += std::max({errors[0], errors[1], errors[2]}) > GROSS;
  }
  static double distance(const double *a, const Quad *b) {
    double square = 0.0;
    for (int k = 0; k < 3; k++) square += std::pow(static_cast<double>(a[k] - b[k]), 2);
    return std::sqrt(square);
  }
};

Answer by_kernel(const GrainPair &pair, double start) {
  const EllipsoidContact c = kernel_contact<Spheroid>(pair, start);
  Answer answer;
  answer.failed = c.fallback;
  answer.touching = c.touching;
  std::copy_n(c.point, 3, answer.point);
  std::copy_n(c.normal, 3, answer.normal);
  answer.overlap = c.depth[0] + c.depth[1];
  return answer;
}

/** What the routine that finds the contact point returns, which LIGGGHTS's surface model does not look at. */
bool liggghts_fails(const GrainPair &pair, const SuperquadricHistory &history, const PairMotion &motion) {
  double centre[2][3] = {}, blockiness[2] = {2.0, 2.0}, point[3], before[3], f[2], still[3] = {}, shift[3], turn[2][3];
  GrainPair p = pair;
  Superquadric one, two;
  std::copy_n(p.d, 3, centre[1]);
  one.set(centre[0], p.quaternion[0], p.semi[0], blockiness);
  two.set(centre[1], p.quaternion[1], p.semi[1], blockiness);
  LIGGGHTS::ContactModels::SurfacesIntersectData data;
  if (history.state == SuperquadricHistory::FAR)
    return MathExtraLiggghtsNonspherical::calc_contact_point_if_no_previous_point_avaialable(data, &one, &two, point,
                                                                                             f[0], f[1], nullptr);
  std::copy_n(history.point, 3, before);
  std::copy_n(motion.shift, 3, shift);
  std::copy_n(&motion.turn[0][0], 6, &turn[0][0]);
  data.mi = data.mj = 1.0;
  data.v_i = still;
  data.v_j = shift;
  data.omega_i = turn[0];
  data.omega_j = turn[1];
  const double r1 = std::cbrt(p.semi[0][0] * p.semi[0][1] * p.semi[0][2]),
               r2 = std::cbrt(p.semi[1][0] * p.semi[1][1] * p.semi[1][2]);
  return MathExtraLiggghtsNonspherical::calc_contact_point_using_prev_step(data, &one, &two, r1 / (r1 + r2), 1.0,
                                                                           before, point, f[0], f[1], nullptr);
}

Answer by_liggghts(const GrainPair &pair, SuperquadricHistory history, const PairMotion &motion) {
  Answer answer;
  answer.failed = liggghts_fails(pair, history, motion);
  SuperquadricPair host(pair, &motion);
  answer.touching = host.contact(history);
  std::copy_n(host.point, 3, answer.point);
  std::copy_n(host.normal, 3, answer.normal);
  answer.overlap = host.overlap;
  return answer;
}

/** In smallest semi-axes. */
double overlap_of(const reference::Contact &c, const GrainPair &pair) {
  return static_cast<double>(c.depth[0] + c.depth[1]) / pair.smallest();
}

/** Two grains of sizes from 0.8 to 1.2, and the direction of their centres. */
GrainPair draw(RandomPairs &random, Posture posture, double alpha) {
  GrainPair pair;
  for (int k = 0; k < 2; k++) random.spheroid(pair, k, alpha, random.uniform(0.8, 1.2));
  random.direction(pair.d, 3);
  if (posture == Posture::random) return pair;
  std::copy_n(pair.quaternion[0], 4, pair.quaternion[1]);
  const int thin = alpha < 1.0 ? 2 : 0, aside = alpha < 1.0 ? 0 : 2;
  const double far = random.uniform(0.0, 0.3) * std::max(alpha, 1.0);
  double axis[2][3];
  rotated_axis(pair.quaternion[0], thin, axis[0]);
  rotated_axis(pair.quaternion[0], aside, axis[1]);
  for (int k = 0; k < 3; k++) pair.d[k] = 2.0 * std::min(alpha, 1.0) * axis[0][k] + far * axis[1][k];
  return pair;
}

/** Moves grain 2 along d until the grains overlap by `overlap` to 1 %, their centres then being (1 - shift) of those of
 *  tangency apart. */
bool place_at_overlap(RandomPairs &random, GrainPair &pair, double overlap, double &shift) {
  double along[3], low = 0.0, high = 1.0;
  std::copy_n(pair.d, 3, along);
  shift = 0.5 * overlap;
  for (int round = 0; round < 100; round++) {
    random.place(pair, shift, along);
    const double found = overlap_of(reference::solve(pair.body(0), pair.body(1), pair.d), pair);
    if (std::fabs(found / overlap - 1.0) < 0.01) return true;
    (found < overlap ? low : high) = shift;
    const double next = shift * overlap / found;
    shift = next > low && next < high ? next : 0.5 * (low + high);
  }
  return false;
}

const char *name(Posture posture) { return posture == Posture::random ? "random" : "aligned"; }
const char *name(Given given) { return given == Given::overlap ? "overlap" : "distance"; }

/** One cell: both surfaces, cold and warm, on the same pairs, and on the same pairs as far apart as they overlapped. */
void cell(Posture posture, double alpha, Given given, double value, long pairs) {
  RandomPairs random(static_cast<unsigned long>(1000 * alpha) + 7);
  Tally tally[2][2];  // LIGGGHTS, kernel; cold, warm
  const char *const who[] = {"superquadric", "ellipsoid"}, *const start[] = {"cold", "warm"};
  for (long n = 0; n < pairs; n++) {
    GrainPair pair = draw(random, posture, alpha), apart;
    const GrainPair drawn = pair;
    double shift = 0.0;
    if (given == Given::overlap) {
      if (!place_at_overlap(random, pair, value, shift)) continue;
    } else {
      const double length = std::sqrt(pair.d[0] * pair.d[0] + pair.d[1] * pair.d[1] + pair.d[2] * pair.d[2]);
      for (double &x : pair.d) x *= value * pair.smallest() / length;
    }
    const double smallest = pair.smallest();
    const PairMotion motion(random, DRIFT * smallest, DRIFT);
    const auto both = [&](const GrainPair &p, bool warm, Answer(&answers)[2]) {
      SuperquadricHistory history;
      if (warm) SuperquadricPair(motion.before(p)).contact(history);
      answers[0] = by_liggghts(p, history, motion);
      answers[1] = by_kernel(p, warm ? kernel_contact<Spheroid>(motion.before(p)).lambda : 0.0);
    };
    const reference::Contact exact = reference::solve(pair.body(0), pair.body(1), pair.d);
    if (given == Given::overlap && (!exact.proved || exact.contact >= 1)) continue;
    apart = drawn;
    random.place(apart, -shift, drawn.d);
    for (int warm = 0; warm < 2; warm++) {
      Answer answers[2];
      both(pair, warm, answers);
      for (int k = 0; k < 2; k++) tally[k][warm].add(answers[k], exact, smallest);
      if (given == Given::distance) continue;
      both(apart, warm, answers);
      for (int k = 0; k < 2; k++) tally[k][warm].invented += answers[k].touching;
    }
  }
  for (int k = 0; k < 2; k++)
    for (int warm = 0; warm < 2; warm++) {
      const Tally &t = tally[k][warm];
      std::printf("%s,%g,%s,%g,%s,%s,%ld,%ld,%ld,%ld,%ld,%ld,%.2g,%.2g,%.2g\n", name(posture), alpha, name(given),
                  value, who[k], start[warm], t.pairs, t.failed, t.not_finite, t.missed, t.invented, t.gross, t.point,
                  t.normal, t.overlap);
    }
  std::fflush(stdout);
}

}

int main(int argc, char **argv) {
  const long pairs = argc > 1 ? std::atol(argv[1]) : 200;
  std::printf("posture,alpha,given,value,surface,start,pairs,failed,not_finite,missed,invented,gross,point,normal,"
              "overlap\n");
  for (Posture posture : {Posture::random, Posture::aligned})
    for (double alpha : {0.05, 0.1, 0.2, 0.33, 0.5, 0.67, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0}) {
      for (double overlap : {1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 3e-2, 1e-1, 3e-1, 5e-1})
        cell(posture, alpha, Given::overlap, overlap, pairs);
      for (double distance : {0.3, 1e-1, 1e-2, 1e-4, 1e-8, 1e-12, 1e-16, 0.0})
        cell(posture, alpha, Given::distance, distance, pairs);
      std::fprintf(stderr, "%s, alpha %g\n", name(posture), alpha);
    }
}

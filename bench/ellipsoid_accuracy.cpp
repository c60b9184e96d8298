// SPDX-License-Identifier: GPL-2.0-or-later
// Errors of the ellipsoid kernel and of LIGGGHTS's superquadric routines against quadruple precision, as Markdown
// tables.
// Usage: ellipsoid_accuracy [pairs per line, default 20000] [overlap: a line for each]
#include "superquadric_pair.h"
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

using namespace grainscope;
using reference::Quad;

namespace {

constexpr double DRIFT = 1e-4;
enum { POINT, NORMAL, OVERLAP, CURVATURE, QUANTITIES };

struct Errors {
  double largest[QUANTITIES] = {}, squares[QUANTITIES] = {};
  long count = 0;

  void add(const double (&error)[QUANTITIES]) {
    for (int q = 0; q < QUANTITIES; q++) {
      largest[q] = std::fmax(largest[q], error[q]);
      squares[q] += error[q] * error[q];
    }
    count++;
  }
  void print() const {
    const auto plain = [](double x) { return x < 1e-20 ? 0.0 : x; };  // exact in double precision
    for (int q = 0; q < QUANTITIES; q++)
      std::printf(" %.0e, %.0e |", plain(largest[q]), plain(std::sqrt(squares[q] / count)));
  }
};

struct Exact {
  reference::Contact contact;
  double smallest, curvature[2];  // roots of the Gaussian curvatures

  explicit Exact(const GrainPair &pair)
      : contact(reference::solve(pair.body(0), pair.body(1), pair.d)), smallest(pair.smallest()) {
    for (int k = 0; k < 2; k++) {
      Quad y[3], k1, k2;
      const Quad along = k ? -contact.depth[1] : contact.depth[0];
      for (int i = 0; i < 3; i++) y[i] = contact.point[i] + along * contact.normal[i] - (k ? pair.d[i] : 0.0);
      reference::curvatures(pair.body(k), y, k1, k2);
      curvature[k] = static_cast<double>(reference::root(k1));
    }
  }

  void compare(const double *point, const double *normal, double overlap, const double *found, Errors &errors) const {
    double squares[2] = {0.0, 0.0}, error[QUANTITIES];
    for (int k = 0; k < 3; k++) {
      squares[0] += std::pow(static_cast<double>(point[k] - contact.point[k]), 2);
      squares[1] += std::pow(static_cast<double>(normal[k] - contact.normal[k]), 2);
    }
    error[POINT] = std::sqrt(squares[0]) / smallest;
    error[NORMAL] = std::sqrt(squares[1]);
    error[OVERLAP] = std::fabs(static_cast<double>(overlap - contact.depth[0] - contact.depth[1])) / smallest;
    error[CURVATURE] = std::fmax(std::fabs(found[0] / curvature[0] - 1.0), std::fabs(found[1] / curvature[1] - 1.0));
    errors.add(error);
  }
};

template <class Body>
void add_kernel(const GrainPair &pair, const Exact &exact, double start, Errors &errors) {
  const EllipsoidContact c = kernel_contact<Body>(pair, start);
  if (c.touching) exact.compare(c.point, c.normal, c.depth[0] + c.depth[1], c.curvature, errors);
}

void add_liggghts(const GrainPair &pair, const Exact &exact, const PairMotion &motion, Errors &errors) {
  SuperquadricHistory history;
  SuperquadricPair(motion.before(pair)).contact(history);
  SuperquadricPair host(pair, &motion);
  if (!host.contact(history)) return;
  const double curvature[2] = {std::sqrt(host.gaussian_curvature(0)), std::sqrt(host.gaussian_curvature(1))};
  exact.compare(host.point, host.normal, host.overlap, curvature, errors);
}

/** One line: all three, from a step ago, with centres `from` to `to` of their distance nearer than at tangency. */
void line(double alpha, double from, double to, long pairs, const std::string &first) {
  RandomPairs random(static_cast<unsigned long>(1000 * alpha));
  Errors spheroids, triaxial, liggghts;
  for (long n = 0; n < pairs; n++) {
    GrainPair pair;
    for (int k = 0; k < 2; k++) random.spheroid(pair, k, alpha);
    random.place(pair, random.logarithmic(from, to));
    const Exact exact(pair);
    const PairMotion motion(random, DRIFT * exact.smallest, DRIFT);
    const double start = kernel_contact<Triaxial>(motion.before(pair)).lambda;
    add_kernel<Spheroid>(pair, exact, start, spheroids);
    add_kernel<Triaxial>(pair, exact, start, triaxial);
    add_liggghts(pair, exact, motion, liggghts);
  }
  for (const auto &[name, errors] : {std::pair<const char *, const Errors &>("spheroid form", spheroids),
                                     {"triaxial form", triaxial},
                                     {"LIGGGHTS", liggghts}}) {
    std::printf("| %s %s |", first.c_str(), name);
    errors.print();
    std::printf("\n");
  }
}

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

}

int main(int argc, char **argv) {
  const long pairs = argc > 1 ? std::atol(argv[1]) : 20000;
  const bool by_overlap = argc > 2;
  std::printf("| alpha |%s by | point | normal | overlap | curvature |\n|---|---|---|---|---|---|%s\n",
              by_overlap ? " shift |" : "", by_overlap ? "---|" : "");
  for (double alpha : {0.05, 0.33, 0.67, 1.0, 1.5, 3.0, 20.0}) {
    if (!by_overlap) line(alpha, 1e-6, 1e-2, pairs, number(alpha) + " |");
    else
      for (double shift : {1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1e-1})
        line(alpha, shift, shift, pairs, number(alpha) + " | " + number(shift) + " |");
  }
}

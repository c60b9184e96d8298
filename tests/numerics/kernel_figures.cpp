// SPDX-License-Identifier: GPL-2.0-or-later
#include "colliding_pair.h"
#include "ellipsoid_bands.h"
#include "ellipsoid_contact.h"
#include "fabric.h"
#include "pair_correlation.h"
#include "principal_axes.h"
#include "side_by_side.h"
#include "spheroid_rotation.h"
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

/** Results of the kernels for inputs that are the same to the last bit whatever compiled them, as rows of text: a name,
 *  what its numbers are measured in, the numbers. compare.py reads several of them. */
namespace {

using namespace grainscope;

/** Numbers at random by whole-number arithmetic, exact divisions and square roots alone: the same everywhere. */
class Random {
 public:
  double uniform(double from, double to) {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return from + (to - from) * (static_cast<double>(state_ >> 11) / 9007199254740992.0);
  }
  void direction(double *v, int n) {
    double square;
    do {
      square = 0.0;
      for (int k = 0; k < n; k++) {
        v[k] = uniform(-1.0, 1.0);
        square += v[k] * v[k];
      }
    } while (square < 0.01 || square > 1.0);
    for (int k = 0; k < n; k++) v[k] /= std::sqrt(square);
  }
  /** From 0.2 to 5, as often below 1 as above. */
  double ratio() { return uniform(0.0, 1.0) < 0.5 ? uniform(0.2, 1.0) : 1.0 / uniform(0.2, 1.0); }

 private:
  std::uint64_t state_ = 88172645463325252ull;
};

void row(const char *name, double unit, std::initializer_list<double> numbers) {
  std::printf("%s %.17g", name, unit);
  for (double x : numbers) std::printf(" %.17g", x);
  std::printf("\n");
}

void contact_row(const char *name, const EllipsoidContact &c, double smallest) {
  if (!c.touching) return row(name, smallest, {0.0, c.gap});
  row(name, smallest,
      {1.0, c.depth[0] + c.depth[1], c.point[0], c.point[1], c.point[2], c.normal[0] * smallest, c.normal[1] * smallest,
       c.normal[2] * smallest});
}

/** 1e5 pairs, half spheroids (four side by side), half triaxial: most of them touch. */
void contacts(Random &random) {
  constexpr int batch = 64;
  for (int n = 0; n < 100000; n += batch) {
    const bool triaxial = n / batch % 2;
    std::vector<SideBySide::Query> pairs(batch);
    std::vector<Triaxial> bodies(2 * batch);
    std::vector<double> smallest(batch, 5.0);
    for (int p = 0; p < batch; p++) {
      for (int side = 0; side < 2; side++) {
        const double a = random.ratio(),
                     semi[3] = {1.0, triaxial ? random.uniform(std::fmin(a, 1.0), std::fmax(a, 1.0)) : 1.0, a};
        double q[4];
        random.direction(q, 4);
        (side ? pairs[p].two : pairs[p].one) = make_spheroid(semi, q);
        bodies[2 * p + side] = make_triaxial(semi, q);
        for (double s : semi) smallest[p] = std::fmin(smallest[p], s);
      }
      pairs[p].start = 0.0;
      random.direction(pairs[p].d, 3);
      const double apart = random.uniform(0.2, 2.0);
      for (double &x : pairs[p].d) x *= apart;
    }
    std::vector<EllipsoidContact> found(batch);
    if (!triaxial) found = SideBySide(pairs).contacts();
    for (int p = 0; p < batch; p++) {
      if (triaxial) found[p] = ellipsoid_contact(bodies[2 * p], bodies[2 * p + 1], pairs[p].d, 0.0);
      contact_row(triaxial ? "triaxial" : "spheroid", found[p], smallest[p]);
    }
  }
}

/** A thousand steps of free tops, the last orientation and angular velocity. */
void rotations(Random &random) {
  for (int n = 0; n < 200; n++) {
    double inertia[3] = {1.0, 1.0, random.ratio()}, momentum[3], q[4], omega[3];
    random.direction(momentum, 3);
    random.direction(q, 4);
    for (int step = 0; step < 1000; step++) rotate_freely(inertia, momentum, 0.01, q, omega);
    row("rotation", 1.0, {q[0], q[1], q[2], q[3], omega[0], omega[1], omega[2]});
  }
}

/** Books of collisions in a sheared frame; their unit is the energy that went in. */
void ledgers(Random &random) {
  for (int n = 0; n < 50; n++) {
    colliding_pair::Pair pair;
    pair.ledger.set_laws(make_law(1.5, grainscope::TangentialLaw::spring, true));
    pair.rolling = 0.1;
    pair.frame.velocity_gradient(0, 1) = random.uniform(-1.0, 1.0);
    for (auto &sphere : pair.spheres)
      for (int k = 0; k < 3; k++) sphere.omega[k] = random.uniform(-1.0, 1.0);
    pair.evaluate(false);
    for (int step = 0; step < 200; step++) pair.step();
    const EnergyLedger::Entries t = pair.ledger.totals();
    using E = EnergyLedger;
    row("ledger", pair.ledger.start_energy(),
        {t[E::W_shear], t[E::W_box], t[E::W_frame], t[E::W_other], t[E::D_n], t[E::D_t], t[E::D_rolling], t[E::G_k],
         t[E::G_p], t[E::G_n], t[E::G_open], t[E::G_dt]});
  }
}

/** Fabric of random normals and its axes; areas of bands; a correlation of random points. */
void sums(Random &random) {
  FabricSums fabric;
  for (int n = 0; n < 1000; n++) {
    Contact c{};
    random.direction(c.normal.data(), 3);
    c.normal = Eigen::Vector3d(2.0 * c.normal[0], c.normal[1], 0.5 * c.normal[2]).normalized();
    c.weight = 1.0;
    fabric.add(c);
  }
  const PrincipalAxes axes(fabric.tensor());
  row("fabric", 1.0,
      {axes.values[0], axes.values[1], axes.values[2], axes.vectors(0, 0), axes.vectors(1, 0), axes.vectors(2, 0)});
  for (double area : band_areas(Eigen::Vector3d(1.0, 0.5, 3.0), 10, SurfaceAngle::polar)) row("bands", 1.0, {area});
  PeriodicCell cell;
  cell.edges(0, 1) = 0.3;
  PointValues points;
  for (int n = 0; n < 500; n++) {
    Eigen::Vector3d s;
    for (int k = 0; k < 3; k++) s[k] = random.uniform(0.0, 1.0);
    points.add(s, random.uniform(-1.0, 1.0));
  }
  const PairSums pairs = direct_pair_sums(cell, points, {0.5, 10});
  for (int k = 0; k < 10; k++) row("correlation", 1.0 + pairs.pairs[k], {pairs.products[0][k], pairs.pairs[k]});
}

}

int main() {
  Random random;
  contacts(random);
  rotations(random);
  ledgers(random);
  sums(random);
  return 0;
}

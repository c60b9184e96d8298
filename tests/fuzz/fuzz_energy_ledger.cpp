// SPDX-License-Identifier: GPL-2.0-or-later
#include "colliding_pair.h"
#include "input.h"

using namespace colliding_pair;

namespace {

Vector3d vector(fuzz::Input &input) { return {input.small(), input.small(), input.small()}; }

void change_frame(fuzz::Input &input, LedgerFrame &frame) {
  for (int a = 0; a < 3; a++)
    for (int b = a; b < 3; b++) frame.velocity_gradient(a, b) = input.small();
  frame.edge_lengths = Vector3d(9.0, 10.0, 11.0) + vector(input);
  frame.edge_rates =
      input.flag() ? Vector3d(frame.velocity_gradient.diagonal().cwiseProduct(frame.edge_lengths)) : vector(input);
  frame.centre = vector(input);
}

/** What went through the books: the scale of their rounding. */
double turnover(const Pair &pair) {
  double sum = 1.0 + std::fabs(pair.ledger.start_energy());
  for (double entry : pair.ledger.totals()) sum += std::fabs(entry);
  for (double store : pair.ledger.stored()) sum += std::fabs(store);
  return sum;
}

}

/** Two grains that collide in any way, in a box that is moved, kicked between steps, under changing forces: the books
 *  close. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzz::Input input(data, size);
  Pair pair(input.logarithmic(1e-6, 1e-2));
  const grainscope::ContactLaw law = make_law(1.5, grainscope::TangentialLaw::spring, input.flag());
  pair.rolling = law.rolls ? input.logarithmic(1e-3, 1.0) : 0.0;
  pair.ledger.set_laws(law);
  for (Sphere &s : pair.spheres) {
    s.mass = input.logarithmic(0.1, 10.0);
    s.inertia = 0.4 * s.mass;
    s.v = vector(input);
    s.omega = vector(input);
  }
  pair.spheres[0].x = Vector3d(-1.0, 0.0, 0.0) + 0.1 * vector(input);
  if (input.flag()) change_frame(input, pair.frame);
  pair.evaluate(false);
  double largest = 0.0;
  for (int n = 0; n < 200 && !input.empty(); n++) {
    const unsigned what = input.byte();
    if (what < 8) pair.outside = vector(input);
    else if (what < 16) pair.spheres[what % 2].v += 0.1 * vector(input);
    else if (what < 24) change_frame(input, pair.frame);
    else if (what < 28) pair.evaluate(false);  // another run begins
    pair.step();
    largest = std::max(largest, turnover(pair));
    fuzz::require_below(std::fabs(pair.residual()), 1e-12 * largest, "the books close");
    const EnergyLedger::Entries totals = pair.ledger.totals();
    const double axes = totals[EnergyLedger::W_box_x] + totals[EnergyLedger::W_box_y] + totals[EnergyLedger::W_box_z];
    fuzz::require_below(std::fabs(axes - totals[EnergyLedger::W_box]), 1e-12 * largest, "axes add up to W_box");
    EnergyLedger again;
    again.restore(pair.ledger.state(), pair.ledger.frame());
    fuzz::require(again.totals() == pair.ledger.totals(), "a restart keeps the books");
  }
  return 0;
}

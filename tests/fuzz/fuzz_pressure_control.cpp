// SPDX-License-Identifier: GPL-2.0-or-later
#include "pressure_control.h"
#include "input.h"

using namespace grainscope;
using fuzz::require;
using fuzz::require_below;

namespace {

Contact contact_of(fuzz::Input &input) {
  Contact c;
  ContactMotion &m = c.motion.emplace();
  input.direction(c.normal.data(), 3);
  c.branch = input.logarithmic(1e-3, 1e3) * c.normal +
             input.small() * Eigen::Vector3d(input.small(), input.small(), input.small());
  c.force = 100.0 * Eigen::Vector3d(input.small(), input.small(), input.small());
  c.weight = input.flag() ? 1.0 : 0.5;
  m.normal_stiffness = input.logarithmic(1e-3, 1e9);
  m.tangential_stiffness = input.flag() ? 0.8 * m.normal_stiffness : 0.0;
  m.damping_coefficient = input.flag() ? input.logarithmic(1e-6, 1e6) : 0.0;
  m.tangential_damping = input.flag() ? m.damping_coefficient : 0.0;
  c.sliding = input.flag();
  m.damped = !c.sliding && m.tangential_damping > 0.0;
  return c;
}

/** The box moves the way that lowers the error, never faster than it may, and says so when it would. */
void check_input(const PressureControl &control, double error, double resistance, double length, double interval) {
  const PressureControl::Input input = control.input(error, resistance, length, interval);
  const double bound = length * std::min(control.limit / interval, control.max_rate);
  require(std::isfinite(input.velocity), "an input is finite", input.velocity);
  require_below(std::fabs(input.velocity), bound, "an input keeps its limit");
  require(input.velocity * error >= 0.0, "the box grows where the pressure is too high", input.velocity);
  require(!input.clipped || std::fabs(input.velocity) == bound, "a clipped input is at the limit", input.velocity);
  require(error != 0.0 || input.velocity == 0.0, "nothing moves at the target", input.velocity);
}

/** As many multiples of the interval are counted as have been passed; a step longer than an interval counts one. */
void check_intervals(fuzz::Input &input) {
  const double interval = input.logarithmic(1e-9, 1e6);
  Intervals intervals(interval);
  double counted = 0.0;
  for (int n = input.whole(1, 40); n > 0; n--) {
    const double step = interval * (input.flag() ? input.logarithmic(1e-6, 0.9) : 0.1);
    counted += intervals.advance(step);
    const double gone = intervals.passed() / interval;
    require(counted == std::floor(gone + 1e-9) + 1.0 || counted == std::floor(gone + 1e-9),
            "multiples of an interval are counted once", counted - gone);
    require(intervals.next() > gone, "the next multiple is yet to come", intervals.next());
    if (input.flag()) {
      Intervals other(interval);
      other.restore(intervals.passed(), intervals.next());
      intervals = other;
    }
  }
}

}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzz::Input input(data, size);
  PressureControl control;
  control.automatic = input.flag();
  control.gain = input.flag() ? input.logarithmic(1e-12, 1e12) : 0.0;
  control.limit = input.uniform(1e-9, 1.0 - 1e-9);
  if (input.flag()) control.max_rate = input.logarithmic(1e-9, 1e9);
  std::vector<int> modes;
  for (int k = 0; k < number_of_box_modes; k++)
    if (input.flag()) modes.push_back(k);
  NetworkResponse evaluation, window;
  ContactLaw law;
  for (int n = input.whole(0, 8); n > 0; n--) {
    law.exponent = input.flag() ? 1.5 : 1.0;
    law.tangential = input.flag() ? TangentialLaw::spring : TangentialLaw::none;
    Contact c = contact_of(input);
    c.law = &law;
    evaluation.add(c, modes);
    for (int k : modes) require(evaluation.resistance(k, k, 1.0) >= 0.0, "a network resists", k);
  }
  window.add(evaluation, input.logarithmic(1e-3, 1.0));
  const double length = input.logarithmic(1e-6, 1e6), interval = input.logarithmic(1e-12, 1e6);
  const double target = input.flag() ? 100.0 * input.uniform(0.0, 1.0) : 0.0;
  for (int k : modes) {
    const double resistance = window.resistance(k, k, interval);
    check_input(control, window.pressure[k] - target, resistance, length, interval);
    check_input(control, 0.0, resistance, length, interval);
    double base = 0.0;
    control.input_with_base(window.pressure[k], resistance, window.stiffness[NetworkResponse::place(k, k)], length,
                            interval, base);
    require(std::isfinite(base), "the base of a rate is finite", base);
  }
  check_intervals(input);

  control.input(input.any(), input.any(), length, interval);  // of a run that has blown up
  return 0;
}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "time_step_bound.h"
#include "input.h"
#include <vector>

using namespace grainscope;
using namespace grainscope::time_step;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using fuzz::require;
using fuzz::require_below;

namespace {

struct Touch {
  Contact contact;
  Vector3d arm;
  ContactLaw law;
};

Touch touch_of(fuzz::Input &input, double size, double stiffness) {
  Touch t;
  Contact &c = t.contact;
  ContactMotion &m = c.motion.emplace();
  if (input.flag()) c.partner = PartnerWall();
  input.direction(c.normal.data(), 3);
  t.arm = size * Vector3d(input.small(), input.small(), input.small());
  m.normal_stiffness = stiffness * input.logarithmic(1e-3, 1e3);
  m.tangential_stiffness = input.uniform(0.0, 1.0) * m.normal_stiffness;
  m.damping_coefficient = input.flag() ? input.logarithmic(1e-9, 1e9) : 0.0;
  m.tangential_damping = input.uniform(0.0, 1.0) * m.damping_coefficient;
  c.sliding = input.flag();
  m.damped = !c.sliding && m.tangential_damping > 0.0;
  t.law.exponent = input.flag() ? 1.5 : 1.0;
  t.law.tangential = input.flag() ? TangentialLaw::spring : TangentialLaw::none;
  return t;
}

GrainModes modes_of(const std::vector<Touch> &touches, std::size_t n, const Matrix3d &turn) {
  GrainModes modes;
  for (std::size_t k = 0; k < n; k++) {
    Contact c = touches[k].contact;
    c.normal = turn * c.normal;
    c.law = &touches[k].law;
    modes.add(c, turn * touches[k].arm);
  }
  return modes;
}

}

/** One grain and its contacts: the bound grows with every contact, is that of its parts, the same however the grain is
 *  turned, and reached at the time step that is given. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzz::Input input(data, size);
  const double radius = input.logarithmic(1e-3, 1e3), mass = input.logarithmic(1e-6, 1e6),
               dt = input.logarithmic(1e-9, 1e3);
  const double stiffness = input.logarithmic(1e-6, 1e9);
  std::vector<Touch> touches(input.whole(0, 8));
  for (Touch &touch : touches) touch = touch_of(input, radius, stiffness);
  double q[4];
  input.direction(q, 4);
  const Matrix3d turn = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix(), still = Matrix3d::Identity();
  const double share = input.logarithmic(0.1, 1.0);
  const Matrix3d inertia = mass * radius * radius * Vector3d(share, 1.0, 0.4).asDiagonal();

  double last = 0.0;
  for (std::size_t n = 0; n <= touches.size(); n++) {
    const GrainModes::Mode mode = modes_of(touches, n, still).fastest(mass, inertia, dt);
    require(std::isfinite(mode.value), "an eigenvalue is finite", mode.value);
    require(mode.value >= last * (1.0 - 1e-9), "a contact more does not make it smaller", mode.value / last);
    require_below(std::fabs(dt * dt * mode.stiffness + dt * mode.damping - mode.value), 1e-9 * mode.value,
                  "it is what its parts make");
    const double step = mode.largest_step();
    require(step > 0.0, "the step at the limit is positive", step);
    if (std::isfinite(step))
      require_below(std::fabs(step * (step * mode.stiffness + mode.damping) / limit - 1.0), 1e-9,
                    "the step that is given is at the limit");
    last = mode.value;
  }
  const GrainModes::Mode turned =
      modes_of(touches, touches.size(), turn).fastest(mass, turn * inertia * turn.transpose(), dt);
  require_below(std::fabs(turned.value - last), 1e-9 * last, "a turned grain has the same bound");
  return 0;
}

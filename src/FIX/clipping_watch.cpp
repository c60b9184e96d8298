// SPDX-License-Identifier: GPL-2.0-or-later
#include "clipping_watch.h"

namespace grainscope {

namespace {

const double often_clipped = 0.2;  // of the inputs, in steady state: by gain auto none are

}

void ClippingWatch::watch(LAMMPS_NS::LAMMPS *lmp, double inputs, const PressureControl::Input &input,
                          const std::string &stress) {
  clipped_ += 0.01 * ((input.clipped ? 1.0 : 0.0) - clipped_);
  settled_ = settled_ || (inputs >= 100.0 && clipped_ < often_clipped / 4.0);
  // Inputs of a start are clipped with one sign, those of an unstable loop with alternating sign.
  const bool reversed = input.clipped && input.velocity * velocity_before_ < 0.0;
  reversed_ += 0.01 * ((reversed ? 1.0 : 0.0) - reversed_);
  velocity_before_ = input.velocity;
  const std::string message =
      who_ +
      ": %.2g of the last hundred inputs were clipped (limit %g), long after the start or with alternating sign: the " +
      stress +
      " is not under control. Use gain auto, a smaller gain or a shorter interval, or raise 'limit' and 'maxrate'";
  warning_.watch(lmp, (settled_ && clipped_ > often_clipped) || reversed_ > often_clipped, message.c_str(), clipped_,
                 often_clipped);
}

}

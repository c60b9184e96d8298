// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CLIPPING_WATCH_H
#define GRAINSCOPE_CLIPPING_WATCH_H

#include "pressure_control.h"
#include "range_warning.h"
#include <string>

namespace grainscope {

/** Warns once when so many inputs of a fix are clipped that its stress is not under control. Fractions are running
 *  means over about a hundred inputs. */
class ClippingWatch {
 public:
  /** `who`: the fix, for the message. */
  explicit ClippingWatch(const char *who = "fix press/strain") : who_(who) {}
  /** After each input; `inputs`: their number so far, this one included; `stress`: what it is to hold. */
  void watch(LAMMPS_NS::LAMMPS *lmp, double inputs, const PressureControl::Input &input, const std::string &stress);

 private:
  std::string who_;
  double clipped_ = 1.0;                           // fraction of inputs; 1 because a start is clipped
  double reversed_ = 0.0, velocity_before_ = 0.0;  // fraction clipped and against the velocity of the input before
  bool settled_ = false;                           // clipping has ceased once
  RangeWarning warning_;
};

}

#endif

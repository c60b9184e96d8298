// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_RANGE_WARNING_H
#define GRAINSCOPE_RANGE_WARNING_H

#include "comm.h"
#include "error.h"
#include "lammps.h"
#include <cstdio>

namespace grainscope {

/** Warns once that a quantity has left the range in which results can be trusted, with its value and the limit. Only
 *  after ten values outside in succession, because the start of a flow passes through much that does not last. */
class RangeWarning {
 public:
  /** `format` takes the two numbers. All ranks may call; rank 0 prints. */
  void watch(LAMMPS_NS::LAMMPS *lmp, bool outside, const char *format, double value, double limit) {
    times_ = outside ? times_ + 1 : 0;
    if (warned_ || times_ < patience) return;
    warned_ = true;
    if (lmp->comm->me != 0) return;
    char message[512];
    snprintf(message, sizeof message, format, value, limit);
    lmp->error->warning(FLERR, message);
  }

 private:
  static constexpr int patience = 10;
  bool warned_ = false;
  int times_ = 0;
};

}

#endif

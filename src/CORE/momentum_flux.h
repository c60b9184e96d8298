// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_MOMENTUM_FLUX_H
#define GRAINSCOPE_MOMENTUM_FLUX_H

#include "affine_flow.h"
#include "symmetric_tensor.h"
#include <array>

namespace grainscope {

/** Grains in rows, of three numbers or one, one after the other. */
struct MovingGrains {
  int count;
  const double *x, *v, *mass;
};

/** Sum of m u and m, u the velocity against the flow. */
std::array<double, 4> momentum_of(const MovingGrains &grains, const AffineFlow &flow);
/** Sum of m (u - mean) (u - mean). */
SixComponents momentum_flux_of(const MovingGrains &grains, const AffineFlow &flow, const Eigen::Vector3d &mean);

}

#endif

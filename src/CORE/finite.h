// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FINITE_H
#define GRAINSCOPE_FINITE_H

#include <cstddef>

namespace grainscope {

/** Whether none of n numbers is NaN or infinite. */
bool all_finite(const double *values, std::size_t n);

}

#endif

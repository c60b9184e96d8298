// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_BIN_INDEX_H
#define GRAINSCOPE_BIN_INDEX_H

namespace grainscope {

// Conversions of a double to an index or a number of items. In C++ the conversion of NaN, or of a number that an int
// cannot hold, is undefined: on x86 it gives the most negative int. The choice is made among doubles, so that loops
// over many numbers can be vectorised.

/** The bin, of `bins` equal ones of width 1 from 0 on, that holds `at`; `none` for what lies outside, is infinite or
 *  no number. */
inline int bin_index(double at, int bins, int none = -1) {
  const double refused = none, below = at < bins ? at : refused;  // one after the other: `&&` would be a branch
  return static_cast<int>(below >= 0.0 ? below : refused);
}

/** The same, but what lies beyond an end is given to the bin there; -1 only for NaN. */
inline int nearest_bin_index(double at, int bins) {
  const double least = at >= 0.0 ? at : at < 0.0 ? 0.0 : -1.0;
  return static_cast<int>(least < bins ? least : bins - 1.0);
}

/** A number of things kept as a double, 0 to `most` (at most 2^53), from a file that may be damaged; -1 when it is no
 *  such number. */
inline long long whole_count(double value, double most) {
  if (!(value >= 0.0 && value <= most)) return -1;
  const long long whole = static_cast<long long>(value);
  return static_cast<double>(whole) == value ? whole : -1;
}

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SUPERQUADRIC_COLUMNS_H
#define GRAINSCOPE_SUPERQUADRIC_COLUMNS_H

namespace grainscope {

/** The first columns of the contact history of `surface superquadric`. With `surface ellipsoid` only the last one is in
 *  memory; restart files and compute pair/gran/local have them all. */
struct SuperquadricColumns {
  static constexpr int count = 7;
  static constexpr int left_out = count - 1;  // of memory
  static constexpr int contact_point = 2, first_depth = 5, second_depth = 6;
  static constexpr const char *kept = "lambda";           // the name of the one that memory holds
  static constexpr const char *first = "inequality_obb";  // of all of them
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SHOWN_ROW_H
#define GRAINSCOPE_SHOWN_ROW_H

#include "superquadric_columns.h"
#include <vector>

namespace grainscope {

/** In an evaluation for output only: a copy of the row of a contact in the contact history, for the models to work on,
 *  followed by the columns of `surface superquadric`. The history itself is not changed. */
class ShownRow {
 public:
  /** `row`, of `width` columns, or the copy if it is that. */
  double *copy(double *row, int width) {
    if (!row_.empty() && row == row_.data()) return row;
    row_.assign(row, row + width);
    row_.resize(width + SuperquadricColumns::count, 0.0);
    return row_.data();
  }
  /** Of the row that was copied last. */
  double *superquadric_columns() { return row_.data() + row_.size() - SuperquadricColumns::count; }

 private:
  std::vector<double> row_;
};

}

#endif

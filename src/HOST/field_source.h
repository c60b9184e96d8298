// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FIELD_SOURCE_H
#define GRAINSCOPE_FIELD_SOURCE_H

#include "field_cells.h"
#include "field_quantities.h"
#include "field_sums.h"

namespace grainscope {

/** A compute whose rows are the cells of a grid, for what averages over time: means are ratios of sums. */
class FieldSource {
 public:
  FieldSource() : number_(++made()) {}
  virtual ~FieldSource() {}
  /** Of all that were ever made: one that was made again is another. */
  long number() const { return number_; }
  /** Of the step that was asked for last, over all ranks. */
  virtual const FieldSums &sums() const = 0;
  /** The cells of that step; of a step of the box as it is where none was asked for. */
  virtual const FieldCells &cells() const = 0;
  virtual const FieldQuantities &quantities() const = 0;
  virtual FieldUnits units() const = 0;
  /** The grid is tilted and stretched as the box is. */
  virtual bool moves_with_box() const = 0;

 private:
  long number_;

  static long &made() {
    static long count = 0;
    return count;
  }
};

}

#endif

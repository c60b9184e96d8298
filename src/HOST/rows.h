// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ROWS_H
#define GRAINSCOPE_ROWS_H

#include <vector>

namespace grainscope {

/** The storage behind a host array, double **: rows of equal width, one after the other, zero at first. */
class Rows {
 public:
  double **resize(int rows, int width) {
    values_.assign(static_cast<std::size_t>(rows) * width, 0.0);
    rows_.resize(rows);
    for (int k = 0; k < rows; k++) rows_[k] = values_.data() + static_cast<std::size_t>(k) * width;
    return rows_.data();
  }
  double bytes() const { return values_.capacity() * sizeof(double) + rows_.capacity() * sizeof(double *); }

 private:
  std::vector<double> values_;
  std::vector<double *> rows_;
};

}

#endif

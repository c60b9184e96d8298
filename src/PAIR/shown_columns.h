// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SHOWN_COLUMNS_H
#define GRAINSCOPE_SHOWN_COLUMNS_H

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace grainscope {

/** Columns of the contact history that an evaluation for output alone writes over, for as long as it is read. */
template <int width>
class ShownColumns {
 public:
  void keep(double *columns) {
    kept_.emplace_back(columns, Values());
    std::copy(columns, columns + width, kept_.back().second.begin());
  }
  void put_back() {
    for (const auto &kept : kept_) std::copy(kept.second.begin(), kept.second.end(), kept.first);
    kept_.clear();
  }

 private:
  using Values = std::array<double, width>;
  std::vector<std::pair<double *, Values>> kept_;
};

}

#endif

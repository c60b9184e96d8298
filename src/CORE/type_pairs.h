// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_TYPE_PAIRS_H
#define GRAINSCOPE_TYPE_PAIRS_H

#include <algorithm>
#include <utility>
#include <vector>

namespace grainscope {

/** The pairs of atom types 1 to n, each once: 1 1, 1 2, ..., 1 n, 2 2, ..., n n. */
class TypePairs {
 public:
  explicit TypePairs(int types = 0) : types_(types) {}

  int size() const { return types_ * (types_ + 1) / 2; }
  /** Number of the pair, from 0, in either order. */
  int index(int a, int b) const {
    const int low = std::min(a, b) - 1, high = std::max(a, b) - 1;
    return low * types_ - low * (low - 1) / 2 + high - low;
  }
  /** All pairs (a, b), a <= b, by their numbers. */
  std::vector<std::pair<int, int>> all() const {
    std::vector<std::pair<int, int>> pairs;
    for (int a = 1; a <= types_; a++)
      for (int b = a; b <= types_; b++) pairs.push_back({a, b});
    return pairs;
  }

 private:
  int types_;
};

}

#endif

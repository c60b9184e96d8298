// SPDX-License-Identifier: GPL-2.0-or-later
#include "nearest_name.h"
#include <algorithm>
#include <numeric>

namespace grainscope {

namespace {

/** Number of letters that are inserted, left out, replaced or swapped with their neighbour. */
int distance(const std::string &a, const std::string &b) {
  std::vector<int> before, last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), 0);
  for (std::size_t i = 1; i <= a.size(); i++) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); j++) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

}

std::string nearest_name(const std::string &name, const std::vector<std::string> &names) {
  const int far = std::max<int>(1, name.size() / 3) + 1;
  int least = far;
  std::string found;
  for (const std::string &one : names)
    if (const int d = distance(name, one); d < least) {
      least = d;
      found = one;
    }
  if (least == far) return "";
  return ": did you mean '" + found + "'?";
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "grain_order.h"
#include "atom.h"
#include "atom_vec.h"
#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace grainscope {

void GrainOrder::prevent_sorting() {
  if (sort_every_ > 0) return;
  sort_every_ = atom->sortfreq;
  atom->sortfreq = 0;
}

void GrainOrder::allow_sorting() {
  if (sort_every_ > 0) atom->sortfreq = sort_every_;
  sort_every_ = 0;
}

void GrainOrder::sort_by_id() {
  const int n = atom->nlocal;
  if (n == atom->nmax) atom->avec->grow(0);
  std::vector<int> wanted(n);  // the k-th is to be the one that is now at wanted[k]
  std::iota(wanted.begin(), wanted.end(), 0);
  std::sort(wanted.begin(), wanted.end(), [this](int a, int b) { return atom->tag[a] < atom->tag[b]; });
  for (int first = 0; first < n; first++) {
    if (wanted[first] == first) continue;
    atom->avec->copy(first, n, 0);
    int hole = first;
    while (wanted[hole] != first) {
      atom->avec->copy(wanted[hole], hole, 0);
      hole = std::exchange(wanted[hole], hole);
    }
    atom->avec->copy(n, hole, 0);
    wanted[hole] = hole;
  }
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_NEAR_PAIRS_H
#define GRAINSCOPE_NEAR_PAIRS_H

#include "separation_memory.h"
#include "neigh_list.h"
#include <vector>

namespace grainscope {

/** Of the pairs of a neighbour list, in its order, those that touch or may soon: the others are surely apart for some
 *  steps, and are not even visited. They are chosen anew when the grains have moved as far as the choice allows for. */
class NearPairs {
 public:
  static constexpr std::size_t AHEAD = 16;  // how far one may look beyond the last
  struct Pair {
    int i, j;
    int number;  // in the neighbour list
    int *flags;  // of the contact history, and its columns
    double *history;
  };

  /** A new neighbour list of this many pairs. */
  void restart() {
    good_until_ = most_ = 0.0;
    chosen_ = false;
  }
  /** `history` may be null. */
  void choose(const LAMMPS_NS::NeighList &list, const LAMMPS_NS::NeighList *history, int columns,
              const SeparationMemory &apart);

  /** Behind them lie as many more as a look ahead may reach. */
  const Pair *pairs() const { return pairs_.data(); }
  std::size_t size() const { return pairs_.size() - AHEAD; }
  int listed() const { return listed_; }

 private:
  static constexpr double STEPS = 8.0;        // that a choice should last
  std::vector<Pair> pairs_;
  int listed_ = 0;
  bool chosen_ = false;
  double most_ = 0.0, good_until_ = 0.0;  // of the sum of two grains' motions
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_NEAR_PAIRS_H
#define GRAINSCOPE_NEAR_PAIRS_H

#include "separation_memory.h"
#include "neigh_list.h"
#include <algorithm>
#include <vector>

namespace grainscope {

/** The pairs of a neighbour list, in its order, that touch or may soon do so. The others are certainly apart for some
 *  steps, and are not visited. The choice is made again when the grains have moved as far as it allows. */
class NearPairs {
 public:
  static constexpr std::size_t AHEAD = 16;  // how far one may look beyond the last
  struct Pair {
    int i, j;
    int number;       // in the neighbour list
    int place;        // of j in the list of i
    double *history;  // its columns of the contact history; null without one
  };

  /** A neighbour list, and what belongs to it in the contact history, which may be null. */
  struct Lists {
    const LAMMPS_NS::NeighList *list, *history;
    int columns;
    Pair pair(int i, int place, int number) const {
      return {i, list->firstneigh[i][place] & NEIGHMASK, number, place,
              history ? history->firstdouble[i] + columns * place : nullptr};
    }
  };

  /** A new neighbour list: for one evaluation all of its pairs are near, and go_through() shows them. */
  void restart(const Lists &lists);
  /** With every other evaluation, after the grains have moved. */
  void choose(const Lists &lists, const SeparationMemory &apart);
  int listed() const { return listed_; }

  /** use(pairs, n) gets all near pairs in order, at most `many` at a time. Behind each lot AHEAD more may be looked
   * at. */
  template <class Use>
  void go_through(const Lists &lists, std::size_t many, const Use &use);

 private:
  static constexpr double STEPS = 8.0;  // that a choice should last
  std::vector<Pair> pairs_;             // chosen, and AHEAD that are none; or some of all
  int listed_ = 0;
  bool chosen_ = false;
  double most_ = 0.0, good_until_ = 0.0;  // of the sum of two grains' motions

  void end_with(std::size_t pairs);
};

template <class Use>
void NearPairs::go_through(const Lists &lists, std::size_t many, const Use &use) {
  if (chosen_) {
    const std::size_t near = pairs_.size() - AHEAD;
    for (std::size_t first = 0; first < near; first += many) use(&pairs_[first], std::min(many, near - first));
    return;
  }
  pairs_.resize(many + AHEAD);
  std::size_t n = 0;
  const auto hand_over = [&] {
    end_with(n);
    use(pairs_.data(), n);
    pairs_.resize(many + AHEAD);
    n = 0;
  };
  int number = 0;
  for (int ii = 0; ii < lists.list->inum; ii++) {
    const int i = lists.list->ilist[ii];
    for (int place = 0; place < lists.list->numneigh[i]; place++) {
      pairs_[n++] = lists.pair(i, place, number++);
      if (n == many) hand_over();
    }
  }
  if (n) hand_over();
}

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#include "near_pairs.h"
#include "fitted.h"

namespace grainscope {

void NearPairs::restart(const Lists &lists) {
  listed_ = 0;
  for (int ii = 0; ii < lists.list->inum; ii++) listed_ += lists.list->numneigh[lists.list->ilist[ii]];
  good_until_ = most_ = 0.0;
  chosen_ = false;
}

/** After the first `pairs`: repeats of the last, which may be looked at. */
void NearPairs::end_with(std::size_t pairs) {
  pairs_.resize(pairs);
  pairs_.resize(pairs + AHEAD, pairs ? pairs_.back() : Pair{});
}

void NearPairs::choose(const Lists &lists, const SeparationMemory &apart) {
  const double most = 2.0 * apart.most_moved(), growth = most - most_;
  most_ = most;
  if (chosen_ && most < good_until_) return;
  good_until_ = most + STEPS * growth;
  chosen_ = true;
  std::size_t near = 0;
  for (int number = 0; number < listed_; number++) near += apart.may_touch_before(number, good_until_);
  fit(pairs_, near + AHEAD);
  Pair *pair = pairs_.data();
  int number = 0;
  for (int ii = 0; ii < lists.list->inum; ii++) {
    const int i = lists.list->ilist[ii], neighbours = lists.list->numneigh[i];
    for (int place = 0; place < neighbours; place++, number++)
      if (apart.may_touch_before(number, good_until_)) *pair++ = lists.pair(i, place, number);
  }
  end_with(near);
}

}

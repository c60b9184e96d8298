// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_NETWORK_H
#define GRAINSCOPE_CONTACT_NETWORK_H

#include "contact.h"
#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace grainscope {

/** Rattlers: grains with fewer than `limit` contacts, where contacts with rattlers do not count. They are removed until
 *  none is left. What remains, the backbone, does not depend on the order: it is the largest set of grains that have
 *  `limit` contacts with each other and with walls. O'Hern, Silbert, Liu & Nagel 2003, doi 10.1103/PhysRevE.68.011306.
 *
 *  A grain has a number on each rank: first the grains that the rank owns, then others (ghosts, or clumps of many
 *  ranks), which the rank does not remove. A contact with a ghost is seen by both owners, each for its own grain.
 *  `held` of a grain is 1 until it is known to be a rattler, then 0. */
class RattlerSearch {
 public:
  static constexpr int wall = -1;

  void reset() { contacts_.clear(); }
  /** Grains i and j, or the wall; `weight` is for contacts() alone. */
  void add(const Contact &c, int i, int j, double weight) { contacts_.push_back({i, j, c.with_own_grain(), weight}); }

  /** Clears `held` of the first `owned` grains as far as is known on this rank. True when it cleared any. */
  bool remove(int limit, int owned, std::vector<double> &held) const {
    bool any = false, again = true;
    while (again) {
      const std::vector<double> found = degrees(held);
      again = false;
      for (int i = 0; i < owned; i++)
        if (held[i] != 0.0 && found[i] < limit) {
          held[i] = 0.0;
          again = true;
        }
      any = any || again;
    }
    return any;
  }
  /** Contacts of each grain with those that are held, as far as this rank owns its side of them. */
  std::vector<double> degrees(const std::vector<double> &held) const {
    std::vector<double> found(held.size(), 0.0);
    for (const Link &c : contacts_) {
      if (!carries(c, held)) continue;
      found[c.i] += 1.0;
      if (c.both_owned) found[c.j] += 1.0;
    }
    return found;
  }
  /** Contacts of the backbone between grains and with walls, weighted. */
  std::array<double, 2> contacts(const std::vector<double> &held) const {
    std::array<double, 2> sums{};
    for (const Link &c : contacts_)
      if (carries(c, held)) sums[c.j == wall] += c.weight;
    return sums;
  }

 private:
  struct Link {
    int i, j;
    bool both_owned;
    double weight;
  };
  std::vector<Link> contacts_;

  static bool carries(const Link &c, const std::vector<double> &held) {
    return held[c.i] != 0.0 && (c.j == wall || held[c.j] != 0.0);
  }
};

/** Sets of grains that are connected by links: trees of grains whose roots represent the sets. */
class ConnectedSets {
 public:
  explicit ConnectedSets(int grains) : parent_(grains) { std::iota(parent_.begin(), parent_.end(), 0); }

  void join(int a, int b) { parent_[root(a)] = root(b); }
  /** Gives each grain the lowest number of its set. True when a number changed. */
  bool spread_lowest(std::vector<double> &numbers) {
    std::vector<double> lowest = numbers;
    for (std::size_t k = 0; k < numbers.size(); k++) {
      double &of_set = lowest[root(static_cast<int>(k))];
      of_set = std::min(of_set, numbers[k]);
    }
    bool changed = false;
    for (std::size_t k = 0; k < numbers.size(); k++) {
      const double of_set = lowest[root(static_cast<int>(k))];
      changed = changed || of_set != numbers[k];
      numbers[k] = of_set;
    }
    return changed;
  }

 private:
  std::vector<int> parent_;

  int root(int k) {
    while (parent_[k] != k) {
      parent_[k] = parent_[parent_[k]];
      k = parent_[k];
    }
    return k;
  }
};

}

#endif

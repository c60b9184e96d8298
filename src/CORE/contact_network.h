// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_NETWORK_H
#define GRAINSCOPE_CONTACT_NETWORK_H

#include "contact.h"
#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace grainscope {

/** Grains that carry nothing: fewer than `limit` contacts, those with rattlers not counted, which are therefore removed
 *  until none is left. What remains, the backbone, does not depend on the order: it is the largest set of grains that
 *  have `limit` contacts with each other and with walls. O'Hern, Silbert, Liu & Nagel 2003, doi
 *  10.1103/PhysRevE.68.011306.
 *
 *  Grains of a rank come first, then ghosts; contacts with ghosts are seen by both owners. `held` of a grain is 1 while
 *  it is not known to be a rattler, then 0. */
class RattlerSearch {
 public:
  void reset() { contacts_.clear(); }
  /** `counts`: in contacts(), too; it holds its grains in any case. */
  void add(const Contact &c, bool counts = true) {
    contacts_.push_back({c.i, c.with_wall() ? wall : c.j(), counts ? c.weight : 0.0});
  }

  /** Clears `held` of the first `owned` grains as far as is known on this rank; ghosts stay as they are. True when it
   *  cleared any. */
  bool remove(int limit, int owned, std::vector<double> &held) {
    bool any = false, again = true;
    while (again) {
      count(owned, held);
      again = false;
      for (int i = 0; i < owned; i++)
        if (held[i] != 0.0 && degree_[i] < limit) {
          held[i] = 0.0;
          again = true;
        }
      any = any || again;
    }
    return any;
  }
  /** Contacts of the backbone between grains and with walls, weighted. */
  std::array<double, 2> contacts(const std::vector<double> &held) const {
    std::array<double, 2> sums{};
    for (const Link &c : contacts_)
      if (carries(c, held)) sums[c.j == wall] += c.weight;
    return sums;
  }

 private:
  static constexpr int wall = -1;
  struct Link {
    int i, j;  // j = wall, or a grain
    double weight;
  };
  std::vector<Link> contacts_;
  std::vector<int> degree_;

  static bool carries(const Link &c, const std::vector<double> &held) {
    return held[c.i] != 0.0 && (c.j == wall || held[c.j] != 0.0);
  }
  void count(int owned, const std::vector<double> &held) {
    degree_.assign(owned, 0);
    for (const Link &c : contacts_) {
      if (!carries(c, held)) continue;
      degree_[c.i]++;
      if (c.j != wall && c.j < owned) degree_[c.j]++;
    }
  }
};

/** Which grains are connected, by links between them: trees of grains whose roots stand for the sets. */
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

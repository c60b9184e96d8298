// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FIELD_SUMS_H
#define GRAINSCOPE_FIELD_SUMS_H

#include <algorithm>
#include <cstddef>
#include <vector>

namespace grainscope {

/** Sums over the grains and contacts of each cell of a field: blocks of numbers, of which those are there that were
 *  asked for. Plain doubles, so that ranks add them up, and times too. */
class FieldSums {
 public:
  /** Weights W of grains are by their centres, of contacts by their points; shares of branches by their parts. */
  enum Block : unsigned {
    volume = 1u << 0,       // of the cell
    grains = 1u << 1,       // sum W
    mass = 1u << 2,         // m W
    solid = 1u << 3,        // volume of grain W
    momentum = 1u << 4,     // m v W, 3
    spin = 1u << 5,         // omega W, 3
    axes = 1u << 6,         // p p W (xx yy zz xy xz yz), W of grains that have an axis p
    centroid = 1u << 7,     // m (x - middle) W, 3
    motion = 1u << 8,       // m v' v' W (xx yy zz xy xz yz), v' against the mean motion about the cell
    force = 1u << 9,        // F_a r_b share: row a, column b, 9
    tangential = 1u << 10,  // likewise F_t
    contacts = 1u << 11,    // W of those between grains, of those with walls
    ends = 1u << 12,        // W at each of the contact's grains
    fabric = 1u << 13,      // n n W (xx yy zz xy xz yz)
    losses = 1u << 14,      // power lost by normal damping, by friction, by tangential damping
    overlaps = 1u << 15,
    traction = 1u << 16  // F of walls on grains W, 3
  };

  FieldSums() = default;
  FieldSums(unsigned blocks, int cells) : blocks_(blocks), cells_(cells) {
    constexpr int widths[kinds] = {1, 1, 1, 1, 3, 3, 7, 3, 6, 9, 9, 2, 1, 6, 3, 1, 3};
    for (int k = 0; k < kinds; k++) {
      place_[k] = width_;
      if (blocks >> k & 1u) width_ += widths[k];
    }
    numbers_.assign(static_cast<std::size_t>(cells) * width_, 0.0);
  }

  bool has(Block block) const { return blocks_ & block; }
  int cells() const { return cells_; }
  /** The same blocks, all 0. */
  FieldSums zero() const { return FieldSums(blocks_, cells_); }
  bool same_layout(const FieldSums &other) const { return blocks_ == other.blocks_ && cells_ == other.cells_; }
  /** Of the same layout; `times`: -1 takes it off. */
  void add(const FieldSums &other, double times = 1.0) {
    for (std::size_t k = 0; k < numbers_.size(); k++) numbers_[k] += times * other.numbers_[k];
  }
  void reset() { std::fill(numbers_.begin(), numbers_.end(), 0.0); }
  std::vector<double> &numbers() { return numbers_; }
  double *of(Block block, int cell) {
    return &numbers_[static_cast<std::size_t>(cell) * width_ + place_[index(block)]];
  }
  const double *of(Block block, int cell) const { return const_cast<FieldSums *>(this)->of(block, cell); }

 private:
  static constexpr int kinds = 17;
  unsigned blocks_ = 0;
  int cells_ = 0, width_ = 0;
  int place_[kinds] = {};
  std::vector<double> numbers_;

  static int index(Block block) { return __builtin_ctz(block); }
};

}

#endif

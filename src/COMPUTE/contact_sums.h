// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_SUMS_H
#define GRAINSCOPE_CONTACT_SUMS_H

#include "contact.h"
#include "contact_compute.h"
#include "type_pairs.h"
#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

namespace grainscope {

inline bool ContactCompute::Selection::has(const Contact &c) const {
  if (narrow && !(types.has(c.type_i, c.type_j) && (!region || region->has(c.motion->point)))) return false;
  return takes_grains_of(c);
}

inline bool ContactCompute::Selection::takes_grains_of(const Contact &c) const {
  const PartnerGrain *other = std::get_if<PartnerGrain>(&c.partner);
  if (!other) return walls != Walls::no && (mask[c.i] & bit);
  return (mask[c.i] & mask[other->index] & bit) && walls != Walls::only;
}

inline ContactCompute::Selection ContactCompute::Selection::everywhere() const {
  Selection all = *this;
  all.region = nullptr;
  return all;
}

/** Calls `use` with each of the contacts that belongs to the measure. */
template <class Use>
void for_each_contact(ContactSpan contacts, ContactCompute::Selection selection, const Use &use) {
  if (!selection.narrow) {
    for (const Contact &c : contacts)
      if (selection.takes_grains_of(c)) use(c);
    return;
  }
  for (const Contact &c : contacts)
    if (selection.has(c)) use(c);
}

/** A contact belongs to a region as a whole, by its contact point. */
struct WholeContacts {
  template <class KernelOf>
  static void add(ContactSpan contacts, const ContactCompute &of, const KernelOf &kernel_of) {
    for_each_contact(contacts, of.selection(), [&kernel_of](const Contact &c) { kernel_of(c).add(c); });
  }
};

/** Of a kernel that takes contacts one by one only. */
struct NoLanes {
  template <class Kernel>
  static bool need_motion(const Kernel &) {
    return false;
  }
  template <class Kernel>
  void add(const ContactLanes &, const Kernel &) {}
  template <class Kernel>
  void move_to(Kernel &) {}
};

/** Sums over the contacts of a compute's group. The kernel has
 *    reset()                 forget everything
 *    add(const Contact &)    one contact; its weight makes sums over ranks count it once
 *    numbers()               what ranks add up: doubles, with data() and size().
 *  InLanes adds up contacts that come side by side:
 *    need_motion(kernel)           whether it reads the motion of GroupForces
 *    add(ContactLanes, kernel)
 *    move_to(kernel)               adds its sums to those of the kernel, and forgets them. */
template <class Kernel, class Way = WholeContacts, class InLanes = NoLanes>
class ContactSums : public ContactCompute::Accumulator {
 public:
  explicit ContactSums(Kernel kernel = Kernel()) : mine_(std::move(kernel)) {}

  void reset() override {
    mine().reset();
    reduced_ = false;
  }
  void add(ContactSpan contacts, const ContactCompute &of) override {
    Way::add(contacts, of, [this](const Contact &) -> Kernel & { return mine_; });
  }
  bool takes_lanes() const override { return !std::is_same<InLanes, NoLanes>::value; }
  void add(const ContactLanes &contacts) override { lanes_.add(contacts, mine_); }
  bool lanes_need_motion() const override { return InLanes::need_motion(mine_); }
  /** Of this rank. */
  Kernel &mine() {
    lanes_.move_to(mine_);
    return mine_;
  }
  /** Of all ranks. Collective, at the first call after an evaluation. */
  const Kernel &total(const ContactCompute &of) {
    if (!reduced_) {
      all_ = mine();
      of.sum_over_ranks(all_.numbers().data(), static_cast<int>(all_.numbers().size()));
      reduced_ = true;
    }
    return all_;
  }

 private:
  Kernel mine_, all_;
  InLanes lanes_;
  bool reduced_ = false;
};

/** The same for each pair of atom types: together they add up to the sums over all contacts. */
template <class Kernel, class Way = WholeContacts>
class TypePairSums : public ContactCompute::Accumulator {
 public:
  explicit TypePairSums(TypePairs pairs, const Kernel &kernel = Kernel())
      : pairs_(pairs), rows_(pairs.size(), kernel) {}

  void reset() override {
    for (Kernel &row : rows_) row.reset();
  }
  void add(ContactSpan contacts, const ContactCompute &of) override {
    Way::add(contacts, of, [this](const Contact &c) -> Kernel & { return rows_[pairs_.index(c.type_i, c.type_j)]; });
  }
  const TypePairs &pairs() const { return pairs_; }
  /** Of all ranks. Collective. */
  std::vector<Kernel> total(const ContactCompute &of) const {
    std::vector<Kernel> all = rows_;
    std::vector<double> numbers;
    for (Kernel &row : all) numbers.insert(numbers.end(), row.numbers().begin(), row.numbers().end());
    of.sum_over_ranks(numbers.data(), static_cast<int>(numbers.size()));
    const double *from = numbers.data();
    for (Kernel &row : all) {
      std::copy_n(from, row.numbers().size(), row.numbers().begin());
      from += row.numbers().size();
    }
    return all;
  }

 private:
  TypePairs pairs_;
  std::vector<Kernel> rows_;
};

}

#endif

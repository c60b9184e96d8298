// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_SUMS_H
#define GRAINSCOPE_CONTACT_SUMS_H

#include "contact.h"
#include "contact_compute.h"
#include <utility>

namespace grainscope {

inline bool ContactCompute::Selection::has(const Contact &c) const {
  const PartnerGrain *other = std::get_if<PartnerGrain>(&c.partner);
  if (!other) return walls != Walls::no && (mask[c.i] & bit);
  return (mask[c.i] & mask[other->index] & bit) && walls != Walls::only;
}

/** Calls `use` with each of the contacts that belongs to the measure. */
template <class Use>
void for_each_contact(ContactSpan contacts, ContactCompute::Selection selection, const Use &use) {
  for (const Contact &c : contacts)
    if (selection.has(c)) use(c);
}

/** Sums over the contacts of a compute's group. The kernel has
 *    reset()                 forget everything
 *    add(const Contact &)    one contact; its weight makes sums over ranks count it once
 *    numbers()               what ranks add up: doubles, with data() and size(). */
template <class Kernel>
class ContactSums : public ContactCompute::Accumulator {
 public:
  explicit ContactSums(Kernel kernel = Kernel()) : mine_(std::move(kernel)) {}

  void reset() override {
    mine_.reset();
    reduced_ = false;
  }
  void add(ContactSpan contacts, const ContactCompute &of) override {
    for_each_contact(contacts, of.selection(), [this](const Contact &c) { mine_.add(c); });
  }
  /** Of this rank. */
  Kernel &mine() { return mine_; }
  /** Of all ranks. Collective, at the first call after an evaluation. */
  const Kernel &total(const ContactCompute &of) {
    if (!reduced_) {
      all_ = mine_;
      of.sum_over_ranks(all_.numbers().data(), static_cast<int>(all_.numbers().size()));
      reduced_ = true;
    }
    return all_;
  }

 private:
  Kernel mine_, all_;
  bool reduced_ = false;
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_LEDGER_REQUIREMENTS_H
#define GRAINSCOPE_LEDGER_REQUIREMENTS_H

#include "pointers.h"
#include <string>
#include <vector>

namespace LAMMPS_NS {
class PairGranInsitu;
}

namespace grainscope {

struct ContactLaw;

/** What the energy ledger of a group requires of contact models, fixes and box. A requirement that is not met ends the
 *  run. Collective. */
class LedgerRequirements : private LAMMPS_NS::Pointers {
 public:
  /** `who`: for messages. */
  LedgerRequirements(LAMMPS_NS::LAMMPS *lmp, int groupbit, const std::string &who)
      : Pointers(lmp), groupbit_(groupbit), who_(who) {}

  void require_known_contacts(LAMMPS_NS::PairGranInsitu &pair) const;
  /** Their laws, which they know when all fixes have been initialised. */
  std::vector<const ContactLaw *> require_known_walls() const;
  /** Group bits: of fixes that move grains, and of fixes freeze. */
  struct Movers {
    int moved = 0, frozen = 0;
    /** Whatever force there is on such a grain, it stays. */
    bool hold(int mask) const { return (mask & frozen) && !(mask & moved); }
  };
  Movers require_moved_by_verlet() const;
  void require_flowing_box() const;

 private:
  int groupbit_;
  std::string who_;

  [[noreturn]] void fail(const std::string &message) const;
  bool shares_grains(int other_groupbit) const;
};

}

#endif

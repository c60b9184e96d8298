// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_LEDGER_GRAINS_H
#define GRAINSCOPE_LEDGER_GRAINS_H

#include "energy_ledger.h"
#include <mpi.h>
#include <cstdint>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
class PairGranInsitu;
}

namespace grainscope {

/** The grains of a ledger at one moment, on this rank, and the energy that each would take with it if it left: its
 *  kinetic energy and the energy stored in its contacts. */
class LedgerGrains {
 public:
  /** A checksum of a set of grains: two different sets have the same one with probability 2^-64. Sums over ranks may be
   *  compared. */
  static std::uint64_t mark(int tag) {
    const std::uint64_t number = static_cast<std::uint64_t>(tag) + 0x9e3779b97f4a7c15;
    return number * number;
  }

  void add(int tag, double kinetic) {
    grains_.push_back({tag, kinetic});
    marks_ += mark(tag);
  }
  /** The contacts of the last evaluation in the contact history, between grains of the group and with walls. */
  void read_contacts(LAMMPS_NS::LAMMPS *lmp, LAMMPS_NS::PairGranInsitu &pair, int groupbit);

  std::uint64_t marks() const { return marks_; }
  /** IDs of those that are not in `other`, on this rank. */
  std::vector<int> not_in(LedgerGrains &other);
  /** The energy that grains with these IDs take with them. `work`: with the work of half a step of their contacts. */
  EnergyLedger::Passage taken_by(const std::vector<int> &tags, bool work) const;
  void forget(const std::vector<int> &tags);

 private:
  struct Grain {
    int tag;
    double kinetic;
    bool operator<(const Grain &other) const { return tag < other.tag; }
  };
  struct StoredEnergy {
    int tags[2];  // the second of a wall is no_tag
    EnergyLedger::Partner partner;
    double normal, spring, normal_work, spring_work;  // the last two of the half step after the evaluation before
  };
  static constexpr int no_tag = -1;
  std::vector<Grain> grains_;
  std::vector<StoredEnergy> contacts_;
  std::uint64_t marks_ = 0;

  void add_contact(const ContactLaw &law, const double *history, double stamp, double weight,
                   EnergyLedger::Partner partner, int tag, int other_tag);
};

/** IDs of grains that left, and that came, between two moments; those that only went to another rank are neither.
 *  Sorted, the same on all ranks. Collective. */
struct PassedGrains {
  std::vector<int> left, came;
  PassedGrains(LedgerGrains &before, LedgerGrains &now, MPI_Comm world);
};

}

#endif

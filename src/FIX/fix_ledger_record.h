// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(ledger/record,FixLedgerRecord)

#else

#ifndef LMP_FIX_LEDGER_RECORD_H
#define LMP_FIX_LEDGER_RECORD_H

#include "contact_sink.h"
#include "energy_ledger.h"
#include "fix.h"
#include <string>

namespace LAMMPS_NS {

/** Keeps the energy ledger of a group up to date in every step, for a compute: sees every contact of every force evaluation, and the grains
 *  before their second kick and before the next step's first. What it has booked is in restart files.
 *  Made by computes, not by input scripts. */
class FixLedgerRecord : public Fix, public grainscope::ContactSink {
 public:
  FixLedgerRecord(class LAMMPS *lmp, int narg, char **arg);
  int setmask();
  void init();
  void pre_initial_integrate();
  void pre_final_integrate();
  void write_restart(FILE *file);
  void restart(char *buffer);

  bool wants_contacts() { return true; }
  void begin_contacts();
  void add_contact(const grainscope::Contact &contact);

  /** Makes the record of compute `id`, in its constructor. Collective. */
  static FixLedgerRecord *make(class LAMMPS *lmp, const char *id, int igroup);
  /** The record that was made, or an error when it is gone. */
  static FixLedgerRecord *find(class LAMMPS *lmp, const char *id);
  /** To be called by the compute's destructor. */
  static void forget(class LAMMPS *lmp, const char *id);

  struct Account {
    grainscope::EnergyLedger::Entries totals, last;
    grainscope::EnergyLedger::Stores stored, change;  // `change`: in the last step
    double residual, last_residual;
  };
  /** Everything booked so far, summed over all ranks. Collective. */
  Account account() const;

 private:
  grainscope::EnergyLedger ledger_;
  class PairGranInsitu *pair_ = nullptr;
  std::string name_;            // of the compute, for messages
  double arrived_ = 0.0;        // grains on this rank at the ends of steps less those at their beginnings: over all ranks 0
  bool stepping_ = false;       // between the two

  [[noreturn]] void fail(const std::string &message) const;
  void require_known_models() const;
  void require_moved_by_verlet() const;
  void require_flowing_box() const;
  grainscope::LedgerFrame frame() const;
  grainscope::EnergyLedger::Grain grain(int i, bool starting) const;
  static std::string id_for(const char *compute);
};

}

#endif
#endif

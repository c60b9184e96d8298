// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_LEDGER_ACCOUNT_H
#define GRAINSCOPE_LEDGER_ACCOUNT_H

#include "energy_ledger.h"
#include <mpi.h>

namespace grainscope {

/** What a fix ledger/record has booked, over all ranks [energy]. */
struct LedgerAccount {
  EnergyLedger::Entries totals, last;   // since the start, and in the last step
  EnergyLedger::Stores stored, change;  // now, and the change in the last step
  double residual, last_residual;

  /** `begins`: no step has been made yet, so that there is no last one. Collective. */
  static LedgerAccount of(const EnergyLedger &ledger, bool begins, MPI_Comm world);
};

}

#endif

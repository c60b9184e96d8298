// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_LEDGER_ACCOUNT_H
#define GRAINSCOPE_LEDGER_ACCOUNT_H

#include "energy_ledger.h"

namespace grainscope {

/** What a fix ledger/record has booked, over all ranks [energy]. */
struct LedgerAccount {
  EnergyLedger::Entries totals, last;   // since the start, and in the last step
  EnergyLedger::Stores stored, change;  // now, and the change in the last step
  double residual, last_residual;
};

}

#endif

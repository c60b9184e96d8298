// SPDX-License-Identifier: GPL-2.0-or-later
#include "ledger_account.h"

namespace grainscope {

LedgerAccount LedgerAccount::of(const EnergyLedger &ledger, bool begins, MPI_Comm world) {
  using E = EnergyLedger;
  LedgerAccount sum;
  double values[2 * E::entries + 2 * E::stores + 1], *at = values;
  const auto put = [&at](const auto &numbers) {
    for (double one : numbers) *at++ = one;
  };
  put(ledger.totals());
  put(ledger.last());
  put(ledger.stored());
  put(ledger.stored_before());
  *at++ = ledger.start_energy();
  MPI_Allreduce(MPI_IN_PLACE, values, at - values, MPI_DOUBLE, MPI_SUM, world);
  at = values;
  const auto take = [&at](auto &numbers) {
    for (double &one : numbers) one = *at++;
  };
  take(sum.totals);
  take(sum.last);
  take(sum.stored);
  take(sum.change);
  for (int k = 0; k < E::stores; k++) sum.change[k] = sum.stored[k] - sum.change[k];
  const double change = E::energy(sum.stored);
  double last_change = E::energy(sum.change);
  if (begins) {  // there is no last step
    sum.last.fill(0.0);
    sum.change.fill(0.0);
    last_change = 0.0;
  }
  sum.residual = E::residual(sum.totals, change - *at);
  sum.last_residual = E::residual(sum.last, last_change);
  return sum;
}

}

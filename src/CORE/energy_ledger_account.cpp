// SPDX-License-Identifier: GPL-2.0-or-later
/** What the ledger reports, and what restart files hold of it. */
#include "energy_ledger.h"
#include <algorithm>

namespace grainscope {

EnergyLedger::Entries EnergyLedger::totals() const {
  Entries sums = totals_;
  for (int k = 0; k < entries; k++) sums[k] += between_[k];
  return sums;
}

double EnergyLedger::residual(const Entries &totals, double stored_change) {
  double supplied = 0.0, gone = 0.0;
  for (int k = W_shear; k <= W_other; k++) supplied += totals[k];
  for (int k = D_n; k < entries; k++) gone += totals[k];
  return supplied - gone - stored_change;
}

EnergyLedger::State EnergyLedger::state() const {
  State state;
  const Entries booked = totals();
  auto at = state.begin();
  at = std::copy(booked.begin(), booked.end(), at);
  at = std::copy(last_.begin(), last_.end(), at);
  at = std::copy(ended_.begin(), ended_.end(), at);
  at = std::copy(stored_before_.begin(), stored_before_.end(), at);
  *at = start_energy_;
  return state;
}

void EnergyLedger::restore(const State &state, const LedgerFrame &frame) {
  auto at = state.begin();
  const auto take = [&at](auto &numbers) {
    for (double &one : numbers) one = *at++;
  };
  between_.fill(0.0);
  take(totals_);
  take(last_);
  take(ended_);
  take(stored_before_);
  start_energy_ = *at;
  stored_ = ended_;
  frame_ = frame;
  started_ = stepped_ = true;
}

}

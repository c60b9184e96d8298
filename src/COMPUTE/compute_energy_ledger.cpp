// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_energy_ledger.h"
#include "arguments.h"
#include "fix_ledger_record.h"
#include "ledger_account.h"
#include "requirements.h"
#include "update.h"
#include <cmath>

using namespace LAMMPS_NS;
using E = grainscope::EnergyLedger;

namespace {

constexpr int residual = E::entries + E::stores, relative = residual + 1, rates = relative + 1, size = rates + residual + 1;

}

ComputeEnergyLedger::ComputeEnergyLedger(LAMMPS *lmp, int &iarg, int narg, char **arg) : Compute(lmp, iarg, narg, arg) {
  grainscope::Arguments arguments(lmp, "compute energy/ledger", iarg, narg, arg);
  arguments.require_none();
  grainscope::require_box(lmp, arguments);
  scalar_flag = vector_flag = 1;
  extscalar = 0;
  extvector = -1;
  size_vector = size;
  extlist = new int[size];
  std::fill(extlist, extlist + size, 1);
  extlist[relative] = 0;
  vector = new double[size]();
  FixLedgerRecord::make(lmp, id, igroup, "energy/ledger");
}

ComputeEnergyLedger::~ComputeEnergyLedger() {
  FixLedgerRecord::forget(lmp, id);
  delete[] vector;
  delete[] extlist;
}

void ComputeEnergyLedger::init() {
  FixLedgerRecord::find(lmp, id);
  invoked_vector = -1;  // what was asked at this step before belongs to another run
}

void ComputeEnergyLedger::compute_vector() {
  invoked_vector = update->ntimestep;
  const grainscope::LedgerAccount account = FixLedgerRecord::find(lmp, id)->account();
  for (int k = 0; k < E::entries; k++) {
    vector[k] = account.totals[k];
    vector[rates + k] = account.last[k] / update->dt;
  }
  for (int k = 0; k < E::stores; k++) {
    vector[E::entries + k] = account.stored[k];
    vector[rates + E::entries + k] = account.change[k] / update->dt;
  }
  double lost = 0.0;
  for (int k = E::D_n; k <= E::D_rolling; k++) lost += std::fabs(account.totals[k]);
  vector[residual] = account.residual;
  vector[rates + residual] = account.last_residual / update->dt;
  vector[relative] = lost == 0.0 ? 0.0 : account.residual / lost;
}

double ComputeEnergyLedger::compute_scalar() {
  invoked_scalar = update->ntimestep;
  if (invoked_vector != update->ntimestep) compute_vector();
  return scalar = std::fabs(vector[relative]);
}

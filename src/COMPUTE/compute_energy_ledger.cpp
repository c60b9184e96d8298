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

constexpr int residual = E::entries + E::stores, relative = residual + 1, rates = relative + 1,
              size = rates + residual + 1;
constexpr auto intensive = grainscope::Extent::intensive, extensive = grainscope::Extent::extensive;

grainscope::Outputs declared() {
  grainscope::OutputList totals;
  totals.add_each("shear box frame other", {"W_*", "energy", extensive, "work W_* since the compute was defined"})
      .add_each("n t damp rolling", {"D_*", "energy", extensive, "loss D_* since the compute was defined"})
      .add_each("k p n open dt", {"G_*", "energy", extensive,
                                  "G_*, what the contact law and the time step take, since the compute was defined"})
      .add_each("U_n U_t K_tr K_rot", {"*", "energy", extensive, "stored energy * now"})
      .add({"residual", "energy", extensive, "what does not add up, since the compute was defined"});
  grainscope::Outputs outputs;
  outputs.vector = totals;
  outputs.vector.add({"residual_relative", "-", intensive,
                      "residual over |D_n| + |D_t| + |D_damp| + |D_rolling|, 0 while nothing was lost"});
  for (const grainscope::NamedOutput &one : totals)
    outputs.vector.add({one.name + "_rate", "energy/time", extensive, "rate of " + one.name + " in the last step"});
  outputs.scalar = {{"imbalance", "-", intensive, "magnitude of residual_relative"}};
  return outputs;
}

}

ComputeEnergyLedger::ComputeEnergyLedger(LAMMPS *lmp, int &iarg, int narg, char **arg) : Compute(lmp, iarg, narg, arg) {
  grainscope::Arguments arguments(lmp, "compute energy/ledger", iarg, narg, arg);
  arguments.require_none();
  grainscope::require_box(lmp, arguments);
  declare(this, declared());
  require_count(size, outputs().vector, "elements");
  FixLedgerRecord::make(lmp, id, igroup, "energy/ledger");
}

ComputeEnergyLedger::~ComputeEnergyLedger() { FixLedgerRecord::forget(lmp, id); }

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

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

constexpr auto intensive = grainscope::Extent::intensive, extensive = grainscope::Extent::extensive;

void add_rates(grainscope::OutputList &vector, const grainscope::OutputList &totals) {
  for (const grainscope::NamedOutput &one : totals)
    vector.add({one.name + "_rate", "energy/time", extensive, "rate of " + one.name + " in the last step"});
}

/** Indices never change: later outputs are behind the rates of the first ones. */
grainscope::Outputs declared() {
  grainscope::OutputList first, later, axes;
  first.add_each("shear box frame other", {"W_*", "energy", extensive, "work W_* since the compute was defined"})
      .add_each("n t damp rolling", {"D_*", "energy", extensive, "loss D_* since the compute was defined"})
      .add_each("k p n open dt", {"G_*", "energy", extensive,
                                  "G_*, what the contact law and the time step take, since the compute was defined"})
      .add_each("U_n U_t K_tr K_rot", {"*", "energy", extensive, "stored energy * now"})
      .add({"residual", "energy", extensive, "what does not add up, since the compute was defined"});
  later.add_each("wall gravity", {"W_*", "energy", extensive, "work W_* since the compute was defined"})
      .add({"W_in", "energy", extensive, "energy of grains that came since the compute was defined"})
      .add({"W_out", "energy", extensive, "energy of grains that left since the compute was defined"})
      .add_each("D_n D_t D_damp D_rolling", {"*_w", "energy", extensive, "share of walls in *"})
      .add({"G_w", "energy", extensive, "share of walls in the sum of all G"})
      .add_each("U_n U_t", {"*_w", "energy", extensive, "share of walls in *"});
  axes.add_each("x y z", {"W_box_*", "energy", extensive, "share of the edges along * in W_box"});
  grainscope::Outputs outputs;
  outputs.vector = first;
  outputs.vector.add({"residual_relative", "-", intensive,
                      "residual over |D_n| + |D_t| + |D_damp| + |D_rolling|, 0 while nothing was lost"});
  add_rates(outputs.vector, first);
  for (const grainscope::OutputList &added : {later, axes}) {
    outputs.vector.insert(outputs.vector.end(), added.begin(), added.end());
    add_rates(outputs.vector, added);
  }
  outputs.scalar = {{"imbalance", "-", intensive, "magnitude of residual_relative"}};
  return outputs;
}

/** A part of the rows, divided by `unit`; behind the last written. */
double *put_part(double *out, const E::Entries &entries, E::Entry begin, E::Entry end, const E::Stores &stores,
                 E::Store stores_begin, E::Store stores_end, double unit) {
  for (int k = begin; k < end; k++) *out++ = entries[k] / unit;
  for (int k = stores_begin; k < stores_end; k++) *out++ = stores[k] / unit;
  return out;
}

}

ComputeEnergyLedger::ComputeEnergyLedger(LAMMPS *lmp, int &iarg, int narg, char **arg) : Compute(lmp, iarg, narg, arg) {
  grainscope::Arguments arguments(lmp, "compute energy/ledger", iarg, narg, arg);
  arguments.require_none();
  grainscope::require_box(lmp, arguments);
  declare(this, declared());
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
  const double dt = update->dt;
  double lost = 0.0;
  for (int k = E::D_n; k <= E::D_rolling; k++) lost += std::fabs(account.totals[k]);
  relative_ = lost == 0.0 ? 0.0 : account.residual / lost;
  double *out = put_part(vector, account.totals, E::W_shear, E::W_wall, account.stored, E::U_n, E::U_n_w, 1.0);
  *out++ = account.residual;
  *out++ = relative_;
  out = put_part(out, account.last, E::W_shear, E::W_wall, account.change, E::U_n, E::U_n_w, dt);
  *out++ = account.last_residual / dt;
  out = put_part(out, account.totals, E::W_wall, E::W_box_x, account.stored, E::U_n_w, E::stores, 1.0);
  out = put_part(out, account.last, E::W_wall, E::W_box_x, account.change, E::U_n_w, E::stores, dt);
  out = put_part(out, account.totals, E::W_box_x, E::entries, account.stored, E::stores, E::stores, 1.0);
  out = put_part(out, account.last, E::W_box_x, E::entries, account.change, E::stores, E::stores, dt);
  require_all_elements(out);
}

double ComputeEnergyLedger::compute_scalar() {
  invoked_scalar = update->ntimestep;
  if (invoked_vector != update->ntimestep) compute_vector();
  return scalar = std::fabs(relative_);
}

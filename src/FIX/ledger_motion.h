// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_LEDGER_MOTION_H
#define GRAINSCOPE_LEDGER_MOTION_H

#include "energy_ledger.h"
#include "ledger_grains.h"
#include "ledger_gravity.h"
#include "ledger_requirements.h"
#include "pointers.h"
#include <memory>

namespace grainscope {

/** Gives a ledger the grains of its group at the beginning and the end of a step, as LIGGGHTS moves them. */
class LedgerMotion : private LAMMPS_NS::Pointers {
 public:
  LedgerMotion(LAMMPS_NS::LAMMPS *lmp, int groupbit, const LedgerRequirements::Movers &movers)
      : Pointers(lmp), groupbit_(groupbit), movers_(movers), gravity_(lmp) {}

  /** Before the first kick. */
  void start_step(EnergyLedger &ledger) const;
  /** Before the second kick. */
  void end_step(EnergyLedger &ledger) const;

  /** In the middle of a step: with the velocities of the half step, before or after grains were dealt out. */
  std::unique_ptr<LedgerGrains> grains_in_step(const EnergyLedger &ledger) const;
  std::unique_ptr<LedgerGrains> grains_between_steps(const EnergyLedger &ledger) const;

 private:
  int groupbit_;
  LedgerRequirements::Movers movers_;
  mutable LedgerGravity gravity_;  // of this moment

  EnergyLedger::Grain shown(int i) const;
  EnergyLedger::Grains all_shown() const;
  template <class Many, class One>
  void show_all(Many many, One one) const;
  Eigen::Vector3d weight(int i) const;
  double inertia_of_sphere(int i) const;
  const double *momentum(int i, double place[3]) const;
  void coming_spin(const EnergyLedger::Grain &grain, double momentum[3], double omega_after[3]) const;
};

}

#endif

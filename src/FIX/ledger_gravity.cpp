// SPDX-License-Identifier: GPL-2.0-or-later
#include "ledger_gravity.h"
#include "fix_gravity.h"
#include "modify.h"
#include <cstring>

namespace grainscope {

LedgerGravity::LedgerGravity(LAMMPS_NS::LAMMPS *lmp) {
  LAMMPS_NS::Modify &modify = *lmp->modify;
  if (modify.n_fixes_style("relax") > 0) return;
  for (int k = 0; k < modify.nfix; k++) {
    LAMMPS_NS::Fix *const fix = modify.fix[k];
    if (!strcmp(fix->style, "freeze"))
      for (Pull &pull : pulls_) pull.frozen |= fix->groupbit;
    else if (LAMMPS_NS::FixGravity *gravity = dynamic_cast<LAMMPS_NS::FixGravity *>(fix))
      pulls_.push_back({gravity, fix->groupbit, 0, Eigen::Vector3d::Zero()});
  }
}

void LedgerGravity::update() {
  for (Pull &pull : pulls_) pull.fix->get_gravity(pull.acceleration.data());
}

Eigen::Vector3d LedgerGravity::acceleration(int mask) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Pull &pull : pulls_)
    if ((mask & pull.group) && !(mask & pull.frozen)) sum += pull.acceleration;
  return sum;
}

}

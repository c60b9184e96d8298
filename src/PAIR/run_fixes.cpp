// SPDX-License-Identifier: GPL-2.0-or-later
#include "run_fixes.h"
#include "internal_fix.h"

namespace grainscope { namespace run_fixes {

namespace {

const char guard_id[] = "gran_insitu_guard", guard[] = "run/guard";
const char memory_id[] = "gran_insitu_setup", memory[] = "setup/memory";

InternalFix *make_last(LAMMPS_NS::LAMMPS *lmp, const InternalFix::Words &words) {
  return InternalFix::make_last(lmp, words, "pair_style gran/insitu needs the fix ID '" + words[0] + "'");
}

}

void make_guard(LAMMPS_NS::LAMMPS *lmp, const std::string &settings) {
  make_last(lmp, {guard_id, "all", guard, settings});
}

std::weak_ptr<EvaluationMemory> make_setup_memory(LAMMPS_NS::LAMMPS *lmp) {
  return dynamic_cast<KeepsEvaluation &>(*make_last(lmp, {memory_id, "all", memory})).evaluation();
}

void remove(LAMMPS_NS::LAMMPS *lmp) {
  InternalFix::remove(lmp, guard_id, guard);
  InternalFix::remove(lmp, memory_id, memory);
}

}}

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_RUN_FIXES_H
#define GRAINSCOPE_RUN_FIXES_H

#include "evaluation_memory.h"
#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace grainscope {

/** The fixes of src/RUN that the pair style makes for itself. They are known here by the names of their styles, because
 *  that folder is on a higher floor. Collective. */
namespace run_fixes {

/** fix run/guard, behind all other fixes; `settings`: the words of the pair style. */
void make_guard(LAMMPS_NS::LAMMPS *lmp, const std::string &settings);
/** fix setup/memory, behind all other fixes, so that its setup() has the last word. */
std::weak_ptr<EvaluationMemory> make_setup_memory(LAMMPS_NS::LAMMPS *lmp);
void remove(LAMMPS_NS::LAMMPS *lmp);

}

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_RESTART_STATE_H
#define GRAINSCOPE_RESTART_STATE_H

#include "state_block.h"
#include "error.h"
#include "fix.h"
#include "lammps.h"
#include <cstdio>
#include <cstring>
#include <type_traits>

namespace grainscope {

/** The state of fixes in restart files. `State` is a struct of numbers with `static constexpr std::uint32_t version`,
 *  which is raised whenever its members, or their meaning, change: a file of another version is refused, with both
 *  versions. `tail`: data without a fixed length; the state holds the length. */
template <class State>
void write_state(std::FILE *file, const State &state, const void *tail = nullptr, std::size_t tail_size = 0) {
  static_assert(std::is_trivially_copyable<State>::value, "a restart file holds bytes");
  const std::vector<char> block = state_block::pack(State::version, &state, sizeof state, tail, tail_size);
  const int size = block.size();
  fwrite(&size, sizeof size, 1, file);
  fwrite(block.data(), 1, size, file);
}

/** In a fix's restart(). Collective, as the host hands the same bytes to all ranks. `style`: as input scripts know
 *  it. */
template <class State>
State read_state(LAMMPS_NS::LAMMPS *lmp, const LAMMPS_NS::Fix &fix, const char *style, const char *block) {
  static_assert(std::is_trivially_copyable<State>::value, "a restart file holds bytes");
  const std::string differs = state_block::what_differs(block, State::version, sizeof(State));
  if (!differs.empty()) lmp->error->all(FLERR, (std::string("fix ") + fix.id + " (" + style + "): " + differs).c_str());
  State state;
  memcpy(&state, state_block::state(block), sizeof state);
  return state;
}

}

#endif

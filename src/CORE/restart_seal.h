// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_RESTART_SEAL_H
#define GRAINSCOPE_RESTART_SEAL_H

#include <cstdint>
#include <string>

namespace grainscope {

/** A restart file ends with a seal: its length and checksum (CRC-32), which LIGGGHTS does not read. A file that was cut
 *  short by a kill, by a full disk, or that was damaged later, has none or one that does not fit. */
namespace restart_seal {

/** Written into the seal; raised when all that grainscope keeps in restart files changes. What one fix keeps has a
 *  version of its own (state_block.h). */
constexpr std::uint32_t format = 2;
/** The style of the fix that seals (FixRunGuard), as its name stands in every file that should have a seal. */
constexpr const char *sealer = "run/guard";

/** Appends the seal and has the system write all of the file to the disk. Returns "", or what went wrong. */
std::string seal(const std::string &file);

struct Verdict {
  bool whole = false;
  // false for a file of LIGGGHTS alone, of which only the beginning and the length can be checked
  bool sealed = false;
  std::int64_t step = -1;  // the step in its header
  std::string reason;      // why it is not whole
};

/** Reads all of the file. */
Verdict examine(const std::string &file);

}

}

#endif

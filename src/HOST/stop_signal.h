// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_STOP_SIGNAL_H
#define GRAINSCOPE_STOP_SIGNAL_H

#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace grainscope {

/** SIGTERM and SIGINT end a run with complete files and a restart file, SIGUSR1 requests a restart file: so does
 *  LIGGGHTS. But in LIGGGHTS every rank acts when the signal reaches it, and ranks that act in different steps wait for
 *  each other for ever. Here a signal is only noted, and the ranks agree on the step. */
namespace stop_signal {

/** Takes the signals over from the host, with what it has noted. */
void watch();
/** Descriptors that a second signal, which ends the process at once, writes its line to; stderr until this is
 *  called. */
void write_last_line_to(const std::vector<int> &where);
/** Gives them back. */
void release();

/** What ranks exchange at the end of a step, as bits. */
enum Request { quit = 1, restart = 2, trouble = 4 };
/** The first two, as far as they have reached this rank. */
int noted();
/** At the end of a step: what has reached any rank is handed to the host, for the coming step, or for this one when
 *  it is the last. */
void forward_to_host(LAMMPS_NS::LAMMPS *lmp, int all);

}

}

#endif

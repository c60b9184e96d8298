// SPDX-License-Identifier: GPL-2.0-or-later
#include "stop_signal.h"
#include "comm.h"
#include "lammps.h"
#include "modify.h"
#include "output.h"
#include "signal_handling.h"
#include "update.h"
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <unistd.h>

namespace SignalHandler = LAMMPS_NS::SignalHandler;

namespace grainscope { namespace stop_signal {

namespace {

const int signals[] = {SIGTERM, SIGINT, SIGUSR1};
struct sigaction before[3];
bool watching = false;
volatile std::sig_atomic_t wants_quit = 0, wants_restart = 0;

const int most = 3;
volatile std::sig_atomic_t descriptors[most] = {STDERR_FILENO}, places = 1;  // of log file, screen and stderr

/** At a second signal. Only what a signal may do: no streams, whose lines are written already. */
[[noreturn]] void end_at_once() {
  const char words[] = "ERROR: the run ends at once, at a second SIGINT or SIGTERM\n";
  bool lost = false;
  for (int k = 0; k < places; k++) lost = write(descriptors[k], words, sizeof words - 1) < 0 || lost;
  std::_Exit(lost ? EXIT_FAILURE + 1 : EXIT_FAILURE);
}

void note(int signal) {
  if (signal == SIGUSR1) wants_restart = 1;
  else if (wants_quit) end_at_once();
  else wants_quit = 1;
}

void say(LAMMPS_NS::LAMMPS *lmp, const char *words) {
  if (lmp->comm->me != 0) return;
  for (FILE *out : {lmp->screen, lmp->logfile})
    if (out) fprintf(out, "%s\n", words);
}

}

void watch() {
  if (watching) return;
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = note;
  for (int signal : signals) sigaddset(&action.sa_mask, signal);
  for (int k = 0; k < 3; k++) sigaction(signals[k], &action, &before[k]);
  watching = true;
  if (SignalHandler::request_quit) wants_quit = 1;
  else if (SignalHandler::request_write_restart) wants_restart = 1;
  SignalHandler::request_quit = SignalHandler::request_write_restart = false;
}

void release() {
  if (!watching) return;
  for (int k = 0; k < 3; k++) sigaction(signals[k], &before[k], nullptr);
  watching = false;
}

void write_last_line_to(const std::vector<int> &where) {
  places = 0;  // in this order: a signal may come in between
  const int n = std::min<int>(where.size(), most);
  for (int k = 0; k < n; k++) descriptors[k] = where[k];
  places = n;
}

int noted() { return (wants_quit ? quit : 0) | (wants_restart ? restart : 0); }

void forward_to_host(LAMMPS_NS::LAMMPS *lmp, int all) {
  if (!(all & (quit | restart))) return;
  wants_restart = 0;
  if ((all & quit) && !SignalHandler::request_quit)
    say(lmp, "SIGINT or SIGTERM: the run ends after the next step, or after this one if it is the last");
  if (!(all & quit) && !SignalHandler::enable_restart_writing)
    return say(lmp, "SIGUSR1: no restart file, because of write_restart_on_signal no");
  SignalHandler::request_write_restart = SignalHandler::enable_restart_writing;
  SignalHandler::request_quit = all & quit;
  // LIGGGHTS prints a row of thermo output on the step: its values must be available. In the last step they are.
  if (lmp->update->ntimestep < lmp->update->laststep) lmp->modify->addstep_compute_all(lmp->update->ntimestep + 1);
  else lmp->output->restart_requested(lmp->update->ntimestep);
}

}}

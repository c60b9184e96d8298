// SPDX-License-Identifier: GPL-2.0-or-later
#include "stop_signal.h"
#include "lammps.h"
#include "modify.h"
#include "signal_handling.h"
#include "update.h"
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <unistd.h>

namespace grainscope {
namespace stop_signal {

namespace {

volatile std::sig_atomic_t wishes = 0;

void say(const char *words) {
  if (write(STDOUT_FILENO, words, strlen(words)) < 0) return;  // nobody is there to be told
}

void note(int signal) {
  if (signal == SIGUSR1) {
    wishes = wishes | restart;
    return;
  }
  if (wishes & quit) {
    say("\nSecond SIGINT or SIGTERM: ending at once\n");
    std::_Exit(EXIT_FAILURE);
  }
  say("\nSIGINT or SIGTERM: ending after the next step\n");
  wishes = wishes | quit;
}

}

void watch() {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = note;
  for (int signal : {SIGTERM, SIGINT, SIGUSR1}) sigaction(signal, &action, nullptr);
}

int noted() { return wishes; }

void pass_on(LAMMPS_NS::LAMMPS *lmp, int all) {
  // At the last step of a run the next run is waited for: the host would leave without a restart.
  if (!(all & (quit | restart)) || lmp->update->ntimestep >= lmp->update->laststep) return;
  using namespace LAMMPS_NS;
  const bool writes = SignalHandler::enable_restart_writing;
  SignalHandler::request_write_restart = writes;
  SignalHandler::request_quit = all & quit;
  if (!(all & quit)) wishes = 0;
  // The host prints a row of thermo output on that step: what it shows must be ready.
  lmp->modify->addstep_compute_all(lmp->update->ntimestep + 1);
}

}
}

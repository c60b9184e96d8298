// SPDX-License-Identifier: GPL-2.0-or-later
/** A program that is started without mpirun. Open MPI 4 would start a daemon with it, and both use a directory in /tmp
 *  that all processes of a user share. A process that ends removes the directory while another starts, which then ends
 *  with exit code 1. A single process needs neither. Set before main and MPI_Init; other MPIs and Open MPI 5 do not
 *  read these variables, and values set by the user are kept. */
#include <algorithm>
#include <cstdlib>
#include <iterator>

namespace {

/** Whether mpirun, srun or another launcher started the program: each sets the rank in the environment. */
bool has_launcher() {
  const char *const launchers[] = {
      "OMPI_COMM_WORLD_SIZE", "PMIX_NAMESPACE", "PMIX_RANK", "PMI_RANK", "PMI_FD", "PMI_ID",
      "ALPS_APP_PE",          "FLUX_JOB_ID"};
  return std::any_of(std::begin(launchers), std::end(launchers),
                     [](const char *name) { return std::getenv(name) != nullptr; });
}

struct StartAlone {
  StartAlone() {
    if (has_launcher()) return;
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  }
};

const StartAlone start_alone;

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "read_restart_sealed.h"
#include "read_restart.h"
#include "restart_seal.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <glob.h>
#include <string>
#include <vector>

using namespace LAMMPS_NS;
using grainscope::restart_seal::Verdict;

namespace {

/** The files that a name with '*' stands for. */
std::vector<std::string> matching(const std::string &name) {
  glob_t found;
  std::vector<std::string> files;
  if (glob(name.c_str(), 0, nullptr, &found) == 0) files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  return files;
}

struct Choice {
  std::string file;
  std::string message;  // an error when there is no file
};

/** The newest of the files that are whole. */
Choice choose(const std::vector<std::string> &names) {
  Choice choice;
  std::vector<std::string> files;
  for (const std::string &name : names) {
    if (name.find('*') == std::string::npos) files.push_back(name);
    else
      for (const std::string &one : matching(name)) files.push_back(one);
  }
  std::int64_t newest = -1;
  std::string refused;
  for (const std::string &file : files) {
    const Verdict verdict = grainscope::restart_seal::examine(file);
    if (!verdict.whole) {
      refused += (refused.empty() ? "" : "; ") + ("'" + file + "' " + verdict.reason);
    } else if (verdict.step > newest) {
      newest = verdict.step;
      choice.file = file;
    }
  }
  if (choice.file.empty())
    choice.message = "read_restart: " + (refused.empty() ? "no file matches '" + names[0] + "'" : refused);
  else if (names.size() > 1 || !refused.empty())
    choice.message = "read_restart: reading '" + choice.file + "', of step " + std::to_string(newest) +
                     (refused.empty() ? "" : "; skipped: " + refused);
  return choice;
}

}

void ReadRestartSealed::command(int narg, char **arg) {
  if (narg < 1)
    error->all(
        FLERR,
        "read_restart: expected the name of a file, or of several to read the newest of, got the end of the command");
  if (domain->box_exist)
    error->all(FLERR, "read_restart: must come before the simulation box is defined, and one is defined");
  const std::vector<std::string> names(arg, arg + narg);
  std::string file = names[0];
  // One file per rank ('%') is neither sealed nor checked.
  if (narg > 1 || file.find('%') == std::string::npos) {
    Choice choice;
    if (comm->me == 0) choice = choose(names);
    for (std::string *text : {&choice.file, &choice.message}) {
      int n = text->size();
      MPI_Bcast(&n, 1, MPI_INT, 0, world);
      text->resize(n);
      MPI_Bcast(&(*text)[0], n, MPI_CHAR, 0, world);
    }
    if (choice.file.empty()) error->all(FLERR, choice.message.c_str());
    if (comm->me == 0 && !choice.message.empty())
      for (FILE *out : {screen, logfile})
        if (out) fprintf(out, "%s\n", choice.message.c_str());
    file = choice.file;
  }
  char *one[] = {&file[0]};
  ReadRestart(lmp).command(1, one);
}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "host_messages.h"
#include "lammps.h"
#include "universe.h"
#include <mpi.h>
#include <cstdarg>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

using LAMMPS_NS::LAMMPS;

namespace grainscope {

namespace {

std::string log_path, screen_path;  // absolute: the input script may change the folder
LAMMPS *running = nullptr;

/** Whether two open files, given by descriptor or path, are the same place. */
bool same_place(const std::string &a, const std::string &b) {
  struct stat first, second, nowhere;
  if (stat(a.c_str(), &first) || stat(b.c_str(), &second)) return false;
  if (!stat("/dev/null", &nowhere) && first.st_rdev == nowhere.st_rdev && S_ISCHR(first.st_mode)) return false;
  return first.st_dev == second.st_dev && first.st_ino == second.st_ino;
}

/** The launcher on this machine, which reads our streams and writes them to its own. */
bool is_launcher(const std::string &process) {
  char name[64] = "";
  if (FILE *file = fopen((process + "/comm").c_str(), "r")) {
    if (!fgets(name, sizeof name, file)) name[0] = '\0';
    fclose(file);
  }
  for (const std::string launcher : {"mpirun", "mpiexec", "orterun", "prterun", "prte", "hydra_pmi_proxy"})
    if (name == launcher + "\n") return true;
  return false;
}

/** Whether stderr is seen where stdout is seen. */
bool one_stream() {
  const std::string self = "/proc/self", parent = "/proc/" + std::to_string(getppid());
  for (const std::string &process : {self, parent})
    if ((process == self || is_launcher(process)) && same_place(process + "/fd/1", process + "/fd/2")) return true;
  return false;
}

/** From a rank that does not have the file open. */
void append_to(const std::string &path, const std::string &text) {
  const int file = path.empty() ? -1 : open(path.c_str(), O_WRONLY | O_APPEND);
  if (file < 0) return;
  if (write(file, text.data(), text.size()) < 0) perror(path.c_str());
  close(file);
}

std::string absolute(const std::string &path) {
  char folder[4096];
  if (path == "none") return "";
  return path[0] != '/' && getcwd(folder, sizeof folder) ? std::string(folder) + "/" + path : path;
}

/** In place of the handler of LIGGGHTS: a rank that aborts alone leaves the others waiting, and their output unwritten.
 */
[[noreturn]] void report_exception() {
  std::string what = "unknown";
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::exception &thrown) {
    what = thrown.what();
  } catch (...) {}
  const int rank = running->universe->me;
  if (FILE *screen = running->screen)
    fprintf(screen, "ERROR on proc %d: an exception ended the program: %s\n", rank, what.c_str());
  last_words(running, "ERROR on proc %d: an exception ended the program: %s\n", rank, what.c_str());
  MPI_Abort(MPI_COMM_WORLD, 1);
  std::abort();
}

}

void begin_messages(LAMMPS *lmp) {
  running = lmp;
  lmp->input = nullptr;  // the host sets them later, and complains before
  lmp->modify = nullptr;
  write_by_line(stdout);
  std::set_terminate(report_exception);
}

void write_by_line(FILE *file) {
  if (!file) return;
  setvbuf(file, nullptr, _IOLBF, BUFSIZ);
  if (file == stdout) return;
  const int descriptor = fileno(file);
  fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) | O_APPEND);  // another rank may have added to it
}

void log_goes_to(const char *path) { log_path = absolute(path); }
void screen_goes_to(const char *path) { screen_path = absolute(path); }

std::vector<int> last_descriptors(LAMMPS *lmp) {
  std::vector<int> found;
  for (FILE *file : {lmp->logfile, lmp->screen == stdout && one_stream() ? nullptr : lmp->screen, stderr})
    if (file) found.push_back(fileno(file));
  return found;
}

void last_words(LAMMPS *lmp, const char *format, ...) {
  char text[4096];
  va_list words;
  va_start(words, format);
  const int length = vsnprintf(text, sizeof text, format, words);
  va_end(words);
  std::string line = text;
  if (length >= static_cast<int>(sizeof text)) line.back() = '\n';

  const LAMMPS_NS::Universe *universe = lmp->universe;
  const bool not_first = universe && universe->me > 0 && universe->nworlds == 1;
  if (lmp->logfile) fputs(line.c_str(), lmp->logfile);
  else if (not_first) append_to(log_path, line);
  if (not_first) append_to(screen_path, line);
  fflush(nullptr);
  FILE *screen = lmp->screen ? lmp->screen : universe ? universe->uscreen : nullptr;
  if (screen == stdout && one_stream()) return;
  fputs(line.c_str(), stderr);
  fflush(stderr);
}

}

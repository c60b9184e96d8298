// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_run_guard.h"
#include "bodies.h"
#include "bin_index.h"
#include "contact_observer.h"
#include "finite.h"
#include "host_messages.h"
#include "pair_gran_insitu.h"
#include "restart_seal.h"
#include "restart_state.h"
#include "stop_signal.h"
#include "tangential_bound.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "update.h"
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <unistd.h>

using namespace LAMMPS_NS;

namespace {

/** In restart files, with the words of the pair style behind it. */
struct SavedGuard {
  static constexpr std::uint32_t version = 1;
  double length;
};

const int fixed_face = 1;  // of the host's numbers for p f s m
const int seldom = 100;    // steps between looks at what a run can do without for a while

struct Quantity {
  const char *name;
  double **values;
  int width;
};

bool finite(const double *values, int n) { return grainscope::all_finite(values, n); }

/** For a file that is written line by line, so that nothing is left to be flushed. Sets errno, by one more line break.
 */
bool lost_a_line(FILE *file) {
  if (!file || file == stdout || !ferror(file)) return false;
  errno = EIO;
  return write(fileno(file), "\n", 1) != 0;
}

std::ostream &operator<<(std::ostream &out, const Quantity &quantity) { return out << quantity.name; }

}

FixRunGuard::FixRunGuard(LAMMPS *lmp, int narg, char **arg)
    : InternalFix(lmp, narg, arg, "pair_style gran/insitu"), settings_(arg[3]),
      warned_of_damping_(std::make_shared<bool>(false)) {
  restart_global = restart_file = 1;
  nevery = 1;
}

int FixRunGuard::setmask() { return FixConst::PRE_EXCHANGE | FixConst::PRE_NEIGHBOR | FixConst::END_OF_STEP; }

void FixRunGuard::init() {
  running_ = false;
  grainscope::stop_signal::watch();
  grainscope::stop_signal::write_last_line_to(grainscope::last_descriptors(lmp));
  fail_on_all_ranks(not_finite(false));
}

void FixRunGuard::setup(int) {
  running_ = true;
  fail_on_all_ranks(not_finite(true));
  warn_of_damping();
}

/** Once. All walls have been evaluated, too. */
void FixRunGuard::warn_of_damping() {
  auto &bound = grainscope::TangentialBound::get();
  if (*warned_of_damping_ || bound.mode() != grainscope::TangentialBound::Mode::watch) return;
  double excess = bound.excess();
  MPI_Allreduce(MPI_IN_PLACE, &excess, 1, MPI_DOUBLE, MPI_MAX, world);
  if (excess == 0.0) return;
  *warned_of_damping_ = true;
  if (comm->me != 0) return;
  std::ostringstream message;
  message << "step " << update->ntimestep << ": LIGGGHTS does not limit tangential damping in the first evaluation of "
          << "a run, and a contact has ";
  if (std::isinf(excess)) message << "a tangential force although its friction is 0";
  else message << "a tangential force of " << excess << " times its friction limit";
  const bool clumps = grainscope::has_bodies(lmp);  // which 'setup neutral' refuses
  message << ". " << (clumps ? "" : "Use 'setup neutral' in pair_style gran/insitu, which limits it, or ")
          << "'tangential_damping off'" << (clumps ? ", which has no such force" : "");
  error->warning(FLERR, message.str().c_str());
}

void FixRunGuard::end_of_step() {
  running_ = true;  // also after 'pre no', which sets nothing up
  std::string trouble = not_finite(true);
  if (trouble.empty() && update->ntimestep % seldom == 0) trouble = not_written();
  int all = grainscope::stop_signal::noted() | (trouble.empty() ? 0 : grainscope::stop_signal::trouble);
  if (comm->nprocs > 1) MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_BOR, world);
  if (all & grainscope::stop_signal::trouble) fail_on_all_ranks(trouble);
  grainscope::stop_signal::forward_to_host(lmp, all);
}

void FixRunGuard::post_run() {
  running_ = false;
  grainscope::stop_signal::write_last_line_to({STDERR_FILENO});  // the log file may be another before the next run
  PairGranInsitu::required_by(lmp, "fix run/guard")->observer().end_run();
  fail_on_all_ranks(not_written());
}

void FixRunGuard::fail_on_all_ranks(const std::string &trouble) const {
  int first = trouble.empty() ? comm->nprocs : comm->me;
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, world);
  if (first == comm->nprocs) return;
  std::string message = trouble;
  int n = message.size();
  MPI_Bcast(&n, 1, MPI_INT, first, world);
  message.resize(n);
  MPI_Bcast(&message[0], n, MPI_CHAR, first, world);
  error->all(FLERR, message.c_str());
}

/** A force that is not finite is found in its own step, before it moves a grain out of the box. */
std::string FixRunGuard::not_finite(bool forces) const {
  const int n = atom->nlocal;
  const Quantity state[] = {{"position", atom->x, 3},
                            {"velocity", atom->v, 3},
                            {"angular velocity", atom->omega, 3},
                            {"quaternion", atom->superquadric_flag ? atom->quaternion : nullptr, 4}};
  const Quantity loads[] = {{"force", atom->f, 3}, {"torque", atom->torque, 3}};
  const auto wrong = [n](const Quantity &one) {
    return n > 0 && one.values && !finite(one.values[0], static_cast<std::size_t>(n) * one.width);
  };
  const Quantity *first = nullptr;
  if (forces)
    for (const Quantity &one : loads)
      if (!first && wrong(one)) first = &one;
  for (const Quantity &one : state)
    if (!first && wrong(one)) first = &one;
  if (!first) return "";

  std::ostringstream message;
  message << "step " << update->ntimestep << ": the " << *first << " of grains";
  int named = 0, all = 0;
  for (int i = 0; i < n; i++) {
    if (finite(first->values[i], first->width)) continue;
    all++;
    if (named++ < 5) message << " " << atom->tag[i];
  }
  if (all > 5) message << " and " << all - 5 << " more";
  message << " is not finite";
  if (forces)
    message << ". Check the time step (doc/stability.md), overlaps of grains that were just inserted, and material "
               "properties";
  else message << ": check the commands that set it";
  return message.str();
}

/** Grains beyond a fixed face may leave: thermo_modify lost. A shrink-wrapped face will be moved beyond them. */
void FixRunGuard::pre_exchange() {
  grains_ = atom->nlocal;
  const auto open = [this](int k, int side) { return domain->boundary[k][side] == fixed_face; };
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < 3; k++)
      if ((open(k, 0) && !(atom->x[i][k] >= domain->boxlo[k])) || (open(k, 1) && !(atom->x[i][k] < domain->boxhi[k]))) {
        grains_--;
        break;
      }
}

/** LIGGGHTS sends grains to their ranks again and drops those that belong to no rank. */
void FixRunGuard::pre_neighbor() {
  bigint lost = grains_ - atom->nlocal;
  MPI_Allreduce(MPI_IN_PLACE, &lost, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (lost <= 0) return;
  std::ostringstream message;
  message << "step " << update->ntimestep << ": " << lost
          << " grains were lost though the box is periodic: they moved farther than its length "
          << "between two neighbour lists. Check the time step (doc/stability.md) and overlaps of grains that were "
             "just inserted";
  error->all(FLERR, message.str().c_str());
}

/** All open streams: LIGGGHTS does not check whether its output is written. A screen that no longer exists is no reason
 *  to end a run. */
std::string FixRunGuard::not_written() const {
  const bool screen_is_gone = fflush(stdout) != 0;
  const bool written = fflush(nullptr) == 0 && !lost_a_line(logfile) && !lost_a_line(screen);
  if (written || screen_is_gone) return "";
  const std::string reason = strerror(errno);
  return "step " + std::to_string(update->ntimestep) +
         ": output of this run (dumps, tables, log) cannot be written: " + reason;
}

/** The words of the pair style, which define the contact history. During a run LIGGGHTS would write springs as they
 *  were before the step: it copies them for restart files when lists are built, which is before forces are evaluated.
 */
void FixRunGuard::write_restart(FILE *file) {
  Fix *springs = running_ ? modify->find_fix_style_strict("contacthistory", 0) : nullptr;
  if (springs) springs->pre_exchange();
  if (comm->me != 0) return;
  const SavedGuard saved{static_cast<double>(settings_.size())};
  grainscope::write_state(file, saved, settings_.data(), settings_.size());
}

void FixRunGuard::restart(char *buffer) {
  const SavedGuard saved = grainscope::read_state<SavedGuard>(lmp, *this, style, buffer);
  const std::string written(grainscope::state_block::tail(buffer), grainscope::whole_count(saved.length, 1e6));
  if (written.empty() || written == settings_ || comm->me != 0) return;
  error->warning(FLERR, ("pair_style gran/insitu: the restart file was written with '" + written +
                         "', this run uses '" + settings_ + "'")
                            .c_str());
}

void FixRunGuard::write_restart_file(char *file) {
  if (strchr(file, '%')) return;
  fail_on_all_ranks(comm->me == 0 ? grainscope::restart_seal::seal(file) : "");
}

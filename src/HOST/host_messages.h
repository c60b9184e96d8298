// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_HOST_MESSAGES_H
#define GRAINSCOPE_HOST_MESSAGES_H

#include <cstdio>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

/** What cmake/mends/messages.cmake puts into the host: no message is lost, and one about a wrong name or index says
 *  what there is. */
namespace grainscope {

/** When the program starts: lines of the screen arrive when they end, and an exception that nobody catches is reported
 *  as an error. */
void begin_messages(LAMMPS_NS::LAMMPS *lmp);
/** Lines of a screen or log file arrive when they end, at its end. None: nothing. */
void write_by_line(FILE *file);
/** Every rank keeps the names of the log file and of the file that `-screen` names, which rank 0 writes; none:
 *  "none". */
void log_goes_to(const char *path);
void screen_goes_to(const char *path);

/** What ends the run, which is on the screen already: to the log file from every rank, and to stderr unless that is
 *  where the screen is. */
void last_words(LAMMPS_NS::LAMMPS *lmp, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** Where the last words of a signal handler go: descriptors of the log file, the screen and stderr, each place once. */
std::vector<int> last_descriptors(LAMMPS_NS::LAMMPS *lmp);

/** An error message about a style, a compute, a fix or a variable in the current command or formula, with what there
 *  is. */
std::string explained(LAMMPS_NS::LAMMPS *lmp, const char *message);

/** The formula that error messages are about, while it is evaluated. */
class FormulaUnderway {
 public:
  explicit FormulaUnderway(const char *formula);
  ~FormulaUnderway();
  FormulaUnderway(const FormulaUnderway &) = delete;
  FormulaUnderway &operator=(const FormulaUnderway &) = delete;

 private:
  const char *outer_;
};

/** The index in "[3]"; an error unless it is one whole number from 1 up. */
int index_in_brackets(LAMMPS_NS::LAMMPS *lmp, const char *brackets);

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_HOST_MESSAGES_H
#define GRAINSCOPE_HOST_MESSAGES_H

#include <cstdio>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

/** The functions that cmake/mends/messages.cmake makes LIGGGHTS call: no message is lost, and a message about a wrong
 *  name or index says what there is. */
namespace grainscope {

/** When the program starts: the screen is written line by line, and an exception that is not caught is reported as an
 *  error. */
void begin_messages(LAMMPS_NS::LAMMPS *lmp);
/** A screen or log file is written line by line, at its end. A null pointer: nothing is done. */
void write_by_line(FILE *file);
/** Every rank keeps the names of the log file and of the file that `-screen` names, which rank 0 writes; none:
 *  "none". */
void log_goes_to(const char *path);
void screen_goes_to(const char *path);

/** Writes the error that ends the run, which is on the screen already, to the log file from every rank, and to stderr
 *  unless the screen goes there. */
void last_words(LAMMPS_NS::LAMMPS *lmp, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** Where the last words of a signal handler go: descriptors of the log file, the screen and stderr, each place once. */
std::vector<int> last_descriptors(LAMMPS_NS::LAMMPS *lmp);

/** An error message about a style, a compute, a fix or a variable in the current command or formula, with what there
 *  is. */
std::string explained(LAMMPS_NS::LAMMPS *lmp, const char *message);

/** The formula that error messages refer to, while it is evaluated. */
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

/** The number that `digits` begins with; the largest int in place of a larger one. */
int whole_index(const char *digits);

/** The error of a command with ${name}, where it has no value. */
std::string without_value(LAMMPS_NS::LAMMPS *lmp, const char *name);

}

#endif

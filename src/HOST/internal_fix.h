// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_INTERNAL_FIX_H
#define GRAINSCOPE_INTERNAL_FIX_H

#include "fix.h"
#include <memory>
#include <string>
#include <vector>

namespace grainscope {

/** A fix that another style makes for itself: the memory of a compute, the guard of a run. An input script cannot make
 *  one, because it would replace what is remembered. All members that make or delete one are collective. */
class InternalFix : public LAMMPS_NS::Fix {
 public:
  /** Words of the command: ID, group, style, further ones. */
  using Words = std::vector<std::string>;

  /** `makers` are for the message that an input script gets. */
  InternalFix(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg, const char *makers);

  /** Makes it, behind all other fixes. `why`: "compute c needs the fix ID 'c_record' for its memory", for an error
   *  when the ID is taken. */
  static InternalFix *make(LAMMPS_NS::LAMMPS *lmp, const Words &words, const std::string &why);
  /** Makes it, or moves it behind all other fixes, with its state; made again when its words have changed. */
  static InternalFix *make_last(LAMMPS_NS::LAMMPS *lmp, const Words &words, const std::string &why);
  /** The one of this ID and style, or null. */
  static InternalFix *find(LAMMPS_NS::LAMMPS *lmp, const std::string &id, const char *style);
  /** Deletes it, if there is one. To be called by destructors, when the host may have few or no fixes left. */
  static void remove(LAMMPS_NS::LAMMPS *lmp, const std::string &id, const char *style);

 protected:
  /** What is handed over when it is moved. */
  virtual std::shared_ptr<void> state() { return nullptr; }
  virtual void take_state(const std::shared_ptr<void> &) {}

 private:
  Words words_;
};

/** The fix ID_suffix that compute ID makes for itself in its constructor, finds in init() and removes in its
 *  destructor. */
struct ComputeFix {
  const char *style, *suffix;
  const char *purpose;  // "memory", as in: needs the fix ID for its memory
  const char *holds;    // "holds the memory", as in: the fix, which holds the memory of the compute, is gone

  InternalFix *make(LAMMPS_NS::LAMMPS *lmp, const char *compute, int igroup, const InternalFix::Words &further) const;
  /** An error when it is gone. */
  InternalFix *find(LAMMPS_NS::LAMMPS *lmp, const char *compute) const;
  void remove(LAMMPS_NS::LAMMPS *lmp, const char *compute) const;

 private:
  std::string id(const char *compute) const { return std::string(compute) + suffix; }
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#include "internal_fix.h"
#include "error.h"
#include "group.h"
#include "modify.h"
#include <cstring>

namespace grainscope {

using LAMMPS_NS::LAMMPS;
using LAMMPS_NS::Modify;

namespace {

bool making = false;

InternalFix *add(LAMMPS *lmp, const InternalFix::Words &words) {
  std::vector<char *> arg;
  for (const std::string &word : words) arg.push_back(const_cast<char *>(word.c_str()));
  making = true;
  lmp->modify->add_fix(arg.size(), arg.data());
  making = false;
  return InternalFix::find(lmp, words[0], words[2].c_str());
}

void require_free(LAMMPS *lmp, const std::string &id, const std::string &why) {
  if (lmp->modify->find_fix(id.c_str()) >= 0) lmp->error->all(FLERR, (why + ", but it is taken").c_str());
}

}

InternalFix::InternalFix(LAMMPS *lmp, int narg, char **arg, const char *makers)
    : Fix(lmp, narg, arg), words_(arg, arg + narg) {
  if (!making) error->all(FLERR, ("fix " + words_[2] + ": is made by " + makers + ", not by an input script").c_str());
}

InternalFix *InternalFix::make(LAMMPS *lmp, const Words &words, const std::string &why) {
  require_free(lmp, words[0], why);
  return add(lmp, words);
}

InternalFix *InternalFix::make_last(LAMMPS *lmp, const Words &words, const std::string &why) {
  const Modify *modify = lmp->modify;
  InternalFix *present = find(lmp, words[0], words[2].c_str());
  if (!present) return make(lmp, words, why);
  if (modify->fix[modify->nfix - 1] == present && present->words_ == words) return present;
  const std::shared_ptr<void> state = present->state();
  lmp->modify->delete_fix(words[0].c_str());
  InternalFix *made = add(lmp, words);
  if (state) made->take_state(state);
  return made;
}

InternalFix *InternalFix::find(LAMMPS *lmp, const std::string &id, const char *style) {
  Modify *modify = lmp->modify;
  const int found = modify && modify->nfix ? modify->find_fix(id.c_str()) : -1;
  const bool known = found >= 0 && strcmp(modify->fix[found]->style, style) == 0;
  return known ? static_cast<InternalFix *>(modify->fix[found]) : nullptr;
}

void InternalFix::remove(LAMMPS *lmp, const std::string &id, const char *style) {
  if (find(lmp, id, style)) lmp->modify->delete_fix(id.c_str());
}

InternalFix *ComputeFix::make(LAMMPS *lmp, const char *compute, int igroup, const InternalFix::Words &further) const {
  InternalFix::Words words{id(compute), lmp->group->names[igroup], style};
  words.insert(words.end(), further.begin(), further.end());
  return InternalFix::make(
      lmp, words, "compute " + std::string(compute) + " needs the fix ID '" + words[0] + "' for its " + purpose);
}

InternalFix *ComputeFix::find(LAMMPS *lmp, const char *compute) const {
  InternalFix *fix = InternalFix::find(lmp, id(compute), style);
  if (!fix)
    lmp->error->all(FLERR, ("fix " + id(compute) + ", which " + holds + " of compute " + compute +
                            ", no longer exists: uncompute it and define it again")
                               .c_str());
  return fix;
}

void ComputeFix::remove(LAMMPS *lmp, const char *compute) const { InternalFix::remove(lmp, id(compute), style); }

}

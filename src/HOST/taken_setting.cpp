// SPDX-License-Identifier: GPL-2.0-or-later
#include "taken_setting.h"
#include "arguments.h"
#include <algorithm>
#include <cstring>

namespace grainscope {

bool take_setting(LAMMPS_NS::LAMMPS *lmp, const std::string &who, std::vector<char *> &words, const char *keyword,
                  const char *no, const char *yes) {
  const auto is_keyword = [keyword](const char *word) { return !strcmp(word, keyword); };
  const auto at = std::find_if(words.begin(), words.end(), is_keyword);
  if (at == words.end()) return false;
  const bool ends = at + 1 == words.end();
  const std::string got = ends ? "" : at[1];
  const std::string about = who + ": '" + keyword + "' ";
  if (got != no && got != yes)
    end_run(lmp,
            about + "must be " + yes + " or " + no + ", got " + (ends ? "the end of the command" : "'" + got + "'"));
  const auto next = words.erase(at, at + 2);
  if (std::any_of(next, words.end(), is_keyword)) end_run(lmp, about + "is given twice");
  return got == yes;
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "host_messages.h"
#include "nearest_name.h"
#include "style_names.h"
#include "compute.h"
#include "error.h"
#include "fix.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <vector>

using LAMMPS_NS::Input;
using LAMMPS_NS::LAMMPS;

namespace grainscope {

namespace {

const char *formula = nullptr;

/** The name of the current command is the host's own matter: a derived class may look. */
struct CurrentCommand : Input {
  static const char *of(Input *input) { return input->*(&CurrentCommand::command); }
};

/** One c_ID[i][j] or f_ID[i][j]. */
struct Reference {
  std::string text, id;
  bool compute;
  std::vector<int> indices;

  bool operator==(const Reference &other) const { return text == other.text; }
};

std::vector<Reference> references_in(const std::string &text) {
  std::vector<Reference> found;
  const auto in_name = [&text](std::size_t k) {
    return k < text.size() && (std::isalnum(static_cast<unsigned char>(text[k])) || text[k] == '_');
  };
  for (std::size_t at = 0; at + 2 < text.size(); at++) {
    if ((text[at] != 'c' && text[at] != 'f') || text[at + 1] != '_' || (at > 0 && in_name(at - 1))) continue;
    std::size_t end = at + 2;
    while (in_name(end)) end++;
    Reference one{"", text.substr(at + 2, end - at - 2), text[at] == 'c', {}};
    while (end < text.size() && text[end] == '[') {
      one.indices.push_back(std::atoi(text.c_str() + end + 1));
      end = std::min(text.find(']', end), text.size() - 1) + 1;
    }
    one.text = text.substr(at, end - at);
    if (!one.id.empty() && std::find(found.begin(), found.end(), one) == found.end()) found.push_back(one);
    at = end - 1;
  }
  return found;
}

template <class Owner>
std::string what_there_is(const Owner &owner) {
  std::vector<std::string> parts;
  if (owner.scalar_flag) parts.push_back("a scalar");
  if (owner.vector_flag) parts.push_back("a vector of " + std::to_string(owner.size_vector));
  if (owner.array_flag)
    parts.push_back("an array of " + std::to_string(owner.size_array_rows) + " rows and " +
                    std::to_string(owner.size_array_cols) + " columns");
  const auto column = [&parts](const char *of, int n) {
    parts.push_back(n ? std::to_string(n) + " columns " + of : std::string("a value ") + of);
  };
  if (owner.peratom_flag) column("per grain", owner.size_peratom_cols);
  if (owner.local_flag) column("per local row", owner.size_local_cols);
  std::string text;
  for (std::size_t k = 0; k < parts.size(); k++)
    text += (k == 0 ? "" : k + 1 < parts.size() ? ", " : " and ") + parts[k];
  return text.empty() ? "nothing" : text;
}

/** Whether the indices fit something that `owner` gives. */
template <class Owner>
bool may_fit(const Reference &r, const Owner &owner) {
  if (r.indices.empty())
    return owner.scalar_flag || owner.vector_flag || owner.array_flag || owner.peratom_flag || owner.local_flag;
  const int last = r.indices.back();
  const auto within = [last](int flag, int n) { return flag && last >= 1 && last <= n; };
  if (r.indices.size() > 1)
    return within(owner.array_flag, owner.size_array_cols) && r.indices[0] <= owner.size_array_rows;
  return within(owner.vector_flag, owner.size_vector) || within(owner.array_flag, owner.size_array_cols) ||
         within(owner.peratom_flag, owner.size_peratom_cols) || within(owner.local_flag, owner.size_local_cols);
}

struct Description {
  std::string text;
  bool fits;
};

template <class Owner>
Description describe(const Reference &r, Owner **owners, int n) {
  const char *kind = r.compute ? "compute" : "fix";
  std::vector<std::string> ids;
  for (int k = 0; k < n; k++) {
    const Owner &owner = *owners[k];
    ids.push_back(owner.id);
    if (r.id == owner.id)
      return {r.text + ": " + kind + " " + r.id + " (" + owner.style + ") gives " + what_there_is(owner),
              may_fit(r, owner)};
  }
  return {r.text + ": there is no " + kind + " '" + r.id + "'" + nearest_name(r.id, ids), false};
}

/** What the references of the formula or command may give: of those that cannot be right, where there are any. */
std::string about_outputs(LAMMPS *lmp) {
  std::string text = formula ? formula : "";
  for (int k = 0; !formula && k < lmp->input->narg; k++) text += std::string(" ") + lmp->input->arg[k];
  const LAMMPS_NS::Modify &modify = *lmp->modify;
  std::vector<Description> all;
  for (const Reference &r : references_in(text))
    all.push_back(r.compute ? describe(r, modify.compute, modify.ncompute) : describe(r, modify.fix, modify.nfix));
  const bool all_fit = std::all_of(all.begin(), all.end(), [](const Description &one) { return one.fits; });
  std::string listed;
  int number = 0;
  for (const Description &one : all)
    if ((all_fit || !one.fits) && number++ < 5) listed += "; " + one.text;
  return listed;
}

bool is_in(const std::vector<std::string> &names, const std::string &name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/** Of a style that does not exist, the nearest that does; of a dump that needs VTK, how to have it. */
std::string about_style(LAMMPS *lmp, const std::string &message) {
  const std::string command = CurrentCommand::of(lmp->input) ? CurrentCommand::of(lmp->input) : "";
  for (const StyleNames &styles : style_names()) {
    const std::string kind = styles.command;
    if (message.rfind("Invalid " + kind + " style", 0) != 0) continue;
    const bool at_once = command == "write_" + kind;  // write_dump group style
    const int place = at_once ? 1 : styles.place;
    if ((!at_once && command != kind && command != kind + "_style") || lmp->input->narg <= place) return "";
    const std::string name = lmp->input->arg[place];
    if (is_in(styles.names, name)) return "";
    const bool named = message.find(name) != std::string::npos;
    const std::string start = named ? "" : ": \"" + name + "\"";
    if (kind == "dump" && is_in(vtk_dump_names(), name))
      return start +
             " needs a build with VTK, cmake -DGRAINSCOPE_VTK=ON; without it, grainscope-tools convert makes files for "
             "ParaView of text dumps (doc/visualise.md)";
    return start + nearest_name(name, styles.names);
  }
  return "";
}

}

std::string explained(LAMMPS *lmp, const char *message) {
  std::string text = message;
  if (!lmp->input || !lmp->modify) return text;
  static const char *const about_names[] = {"accessed out-of-range",
                                            "is not large enough",
                                            "does not compute",
                                            "does not calculate",
                                            "Mismatched compute",
                                            "Mismatched fix",
                                            "Could not find",
                                            "Compute ID for",
                                            "Fix ID for",
                                            "Invalid compute ID",
                                            "Invalid fix ID",
                                            "must be an index",
                                            "between brackets in variable",
                                            "variable brackets must be positive"};
  const auto contains = [&text](const char *words) { return text.find(words) != std::string::npos; };
  if (contains("group ID")) return text;
  if (std::any_of(std::begin(about_names), std::end(about_names), contains)) return text + about_outputs(lmp);
  return text + about_style(lmp, text);
}

FormulaUnderway::FormulaUnderway(const char *text) : outer_(formula) { formula = text; }
FormulaUnderway::~FormulaUnderway() { formula = outer_; }

int index_in_brackets(LAMMPS *lmp, const char *brackets) {
  const char *digits = brackets + 1, *end = digits + std::strspn(digits, "0123456789");
  const int index = end - digits < 10 ? std::atoi(digits) : 0;
  if (index < 1 || std::strcmp(end, "]") != 0)
    lmp->error->all(
        FLERR, ("what is in brackets must be an index, a whole number from 1 up, got '" + std::string(brackets) + "'")
                   .c_str());
  return index;
}

}

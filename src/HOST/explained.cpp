// SPDX-License-Identifier: GPL-2.0-or-later
#include "host_messages.h"
#include "nearest_name.h"
#include "outputs.h"
#include "style_names.h"
#include "compute.h"
#include "error.h"
#include "fix.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "variable.h"
#include <algorithm>
#include <cctype>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <map>
#include <vector>

using LAMMPS_NS::Input;
using LAMMPS_NS::LAMMPS;

namespace grainscope {

namespace {

const char *formula = nullptr;

/** Access to the name of the current command, which is protected in LIGGGHTS. */
struct CurrentCommand : Input {
  static const char *of(Input *input) { return input->*(&CurrentCommand::command); }
};

/** One c_ID[i][j], f_ID[i][j] or v_ID. */
struct Reference {
  std::string text, id;
  char kind;  // c, f or v
  std::vector<int> indices;

  bool operator==(const Reference &other) const { return text == other.text; }
};

std::vector<Reference> references_in(const std::string &text) {
  std::vector<Reference> found;
  const auto in_name = [&text](std::size_t k) {
    return k < text.size() && (std::isalnum(static_cast<unsigned char>(text[k])) || text[k] == '_');
  };
  for (std::size_t at = 0; at + 2 < text.size(); at++) {
    const bool is_kind = text[at] == 'c' || text[at] == 'f' || text[at] == 'v';
    if (!is_kind || text[at + 1] != '_' || (at > 0 && in_name(at - 1))) continue;
    std::size_t end = at + 2;
    while (in_name(end)) end++;
    Reference one{"", text.substr(at + 2, end - at - 2), text[at], {}};
    while (end < text.size() && text[end] == '[') {
      one.indices.push_back(whole_index(text.c_str() + end + 1));
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
  const char *kind = r.kind == 'c' ? "compute" : "fix";
  std::vector<std::string> ids;
  for (int k = 0; k < n; k++) {
    const Owner &owner = *owners[k];
    ids.push_back(owner.id);
    if (r.id != owner.id) continue;
    const auto *const declared = dynamic_cast<const DeclaresOutputs *>(owners[k]);
    const std::string style = declared ? declared->declared_style() : owner.style;
    const std::string named = declared ? ", listed by 'outputs " + r.id + "' and in " + declared->page() : "";
    return {r.text + ": " + kind + " " + r.id + " (" + style + ") gives " + what_there_is(owner) + named,
            may_fit(r, owner)};
  }
  return {r.text + ": there is no " + kind + " '" + r.id + "'" + nearest_name(r.id, ids), false};
}

/** The computes and fixes whose outputs have names, by ID. */
template <class Owner>
void add_declared(Owner **owners, int n, std::map<std::string, const DeclaresOutputs *> &all) {
  for (int k = 0; k < n; k++)
    if (const auto *const declared = dynamic_cast<const DeclaresOutputs *>(owners[k])) all[owners[k]->id] = declared;
}

/** A variable that does not exist: the command `outputs` may define it, or one of nearly the same name. */
std::string describe_missing_variable(const std::string &name, const LAMMPS_NS::Modify &modify) {
  std::map<std::string, const DeclaresOutputs *> all;
  add_declared(modify.compute, modify.ncompute, all);
  add_declared(modify.fix, modify.nfix, all);
  std::vector<std::string> names;
  std::string defined_by;
  for (const auto &one : all) {
    if (name.rfind(one.first + "_", 0) == 0)
      defined_by = "'outputs " + one.first + "' defines variables for all its outputs (" + one.second->page() + ")";
    for (const OutputList *list : {&one.second->outputs().scalar, &one.second->outputs().vector})
      for (const NamedOutput &output : *list) names.push_back(one.first + "_" + output.name);
  }
  const bool exact = std::find(names.begin(), names.end(), name) != names.end();
  const std::string nearest = exact ? "" : nearest_name(name, names);
  return "v_" + name + ": there is no variable '" + name + "'" + nearest +
         (defined_by.empty() ? "" : (nearest.empty() ? ": " : " ") + defined_by);
}

/** Whether a word of a command begins with a reference, and is not the name of a file as c_run.txt. */
bool is_reference(const std::string &word) {
  const std::vector<Reference> found = references_in(word);
  return !found.empty() && word.rfind(found[0].text, 0) == 0 && (word == found[0].text || !found[0].indices.empty());
}

/** The formula, or the words of the command that are references or texts with some. */
std::string with_references(const Input &input) {
  if (formula) return formula;
  std::string text;
  for (int k = 0; k < input.narg; k++) {
    const std::string word = input.arg[k];
    if (word.find_first_of(" (") != std::string::npos || is_reference(word)) text += " " + word;
  }
  return text;
}

/** What the references of the formula or command may give; if some of them cannot be right, only these. */
std::string about_outputs(LAMMPS *lmp) {
  const std::string text = with_references(*lmp->input);
  const LAMMPS_NS::Modify &modify = *lmp->modify;
  std::vector<Description> all;
  for (const Reference &r : references_in(text)) {
    const bool exists = r.kind == 'v' && lmp->input->variable->find(const_cast<char *>(r.id.c_str())) >= 0;
    if (r.kind == 'c') all.push_back(describe(r, modify.compute, modify.ncompute));
    else if (r.kind == 'f') all.push_back(describe(r, modify.fix, modify.nfix));
    else if (!exists) all.push_back({describe_missing_variable(r.id, modify), false});
  }
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
                                            "ariable name",
                                            "index in brackets must",
                                            "between brackets in variable",
                                            "variable brackets must be positive"};
  const auto contains = [&text](const char *words) { return text.find(words) != std::string::npos; };
  if (contains("group ID")) return text;
  if (std::any_of(std::begin(about_names), std::end(about_names), contains)) return text + about_outputs(lmp);
  return text + about_style(lmp, text);
}

std::string without_value(LAMMPS *lmp, const char *name) {
  const std::string message = "Substitution for illegal variable; ";
  if (lmp->input->variable->find(const_cast<char *>(name)) < 0)
    return message + describe_missing_variable(name, *lmp->modify);
  return message + "variable '" + name + "' has no value here";
}

FormulaUnderway::FormulaUnderway(const char *text) : outer_(formula) { formula = text; }
FormulaUnderway::~FormulaUnderway() { formula = outer_; }

int whole_index(const char *digits) {
  return static_cast<int>(std::min(std::strtol(digits, nullptr, 10), static_cast<long>(INT_MAX)));
}

int index_in_brackets(LAMMPS *lmp, const char *brackets) {
  const char *digits = brackets + 1, *end = digits + std::strspn(digits, "0123456789");
  const int index = end - digits < 10 ? std::atoi(digits) : 0;
  if (index < 1 || std::strcmp(end, "]") != 0)
    lmp->error->all(FLERR,
                    ("the index in brackets must be a whole number >= 1, got '" + std::string(brackets) + "'").c_str());
  return index;
}

}

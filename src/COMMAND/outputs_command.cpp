// SPDX-License-Identifier: GPL-2.0-or-later
#include "outputs_command.h"
#include "arguments.h"
#include "compute.h"
#include "fix.h"
#include "comm.h"
#include "input.h"
#include "modify.h"
#include "nearest_name.h"
#include "outputs.h"
#include "variable.h"
#include <algorithm>
#include <cctype>
#include <map>

using namespace LAMMPS_NS;
using grainscope::Arguments;
using grainscope::DeclaresOutputs;
using grainscope::Extent;
using grainscope::NamedOutput;
using grainscope::OutputList;
using grainscope::Outputs;

namespace {

/** A private member of the class Variable of LIGGGHTS: the texts of all variables. An explicit instantiation may name
 *  it. */
struct TextsOfVariables {
  using Member = char ***Variable::*;
  friend Member member_of(TextsOfVariables);
};
template <class Tag, typename Tag::Member M>
struct Named {
  friend typename Tag::Member member_of(Tag) { return M; }
};
template struct Named<TextsOfVariables, &Variable::data>;

struct Source {
  std::string id, description;  // "compute stress (stress/contact)"
  std::string reads;            // "c_stress"
  const DeclaresOutputs *declared;
};

template <class Owner>
void add_sources(Owner **owners, int n, const char *kind, std::vector<Source> &all) {
  for (int k = 0; k < n; k++) {
    const auto *declared = dynamic_cast<DeclaresOutputs *>(owners[k]);
    const std::string id = owners[k]->id, style = declared ? declared->declared_style() : owners[k]->style;
    all.push_back(
        {id, std::string(kind) + " " + id + " (" + style + ")", std::string(1, kind[0]) + "_" + id, declared});
  }
}

/** The compute or fix of that name; an error that says what there is. */
Source source_of(const Modify &modify, const std::string &id, const Arguments &errors) {
  std::vector<Source> all, found;
  add_sources(modify.compute, modify.ncompute, "compute", all);
  add_sources(modify.fix, modify.nfix, "fix", all);
  std::vector<std::string> named;
  std::string other;
  for (const Source &one : all) {
    if (one.declared) named.push_back(one.id);
    if (one.id != id) continue;
    if (one.declared) found.push_back(one);
    else other = one.description;
  }
  const std::string requirement = "'ID' must be the ID of a compute or fix with named outputs, got '" + id + "'";
  const std::string page = " (doc/outputs.md)";
  if (found.size() > 1)
    errors.fail(requirement + ", which is the ID of both " + found[0].description + " and " + found[1].description +
                ": rename one");
  if (found.empty() && !other.empty()) errors.fail(requirement + ": the outputs of " + other + " have no names" + page);
  if (found.empty()) errors.fail(requirement + grainscope::nearest_name(id, named) + page);
  return found[0];
}

struct Line {
  std::string kind, index;
  const NamedOutput *output;
  std::string variable, formula;  // none: not defined
  std::string read_as;
};

std::string in_brackets(std::size_t k) { return "[" + std::to_string(k) + "]"; }

/** Every output with the expression that reads it. */
std::vector<Line> lines_of(const Source &source, const std::string &prefix) {
  const Outputs &outputs = source.declared->outputs();
  std::vector<Line> lines;
  const auto define = [&](const char *kind, const std::string &index, const NamedOutput &one,
                          const std::string &formula) {
    const std::string name = prefix + "_" + one.name;
    lines.push_back({kind, index, &one, name, formula, "v_" + name + " = " + formula});
  };
  const auto list = [&](const char *kind, const OutputList &all, const std::string &before) {
    for (std::size_t k = 0; k < all.size(); k++) {
      const std::string index = all.size() > 1 ? in_brackets(k + 1) : "";
      lines.push_back({kind, std::to_string(k + 1), &all[k], "", "", source.reads + before + index});
    }
  };
  for (const NamedOutput &one : outputs.scalar) {
    const auto &vector = outputs.vector;
    const auto same =
        std::find_if(vector.begin(), vector.end(), [&one](const NamedOutput &o) { return o.name == one.name; });
    if (same == vector.end()) {
      define("scalar", "-", one, source.reads);
      continue;
    }
    const std::string element = source.reads + in_brackets(same - vector.begin() + 1);
    lines.push_back({"scalar", "-", &one, "", "", source.reads + ", the same as " + element});
  }
  for (std::size_t k = 0; k < outputs.vector.size(); k++)
    define("vector", std::to_string(k + 1), outputs.vector[k], source.reads + in_brackets(k + 1));
  list("array", outputs.columns, "[i]");
  list("per grain", outputs.per_grain, "");
  list("local", outputs.local, "");
  return lines;
}

const char *text_of(Extent extent) {
  return extent == Extent::intensive ? "intensive" : extent == Extent::extensive ? "extensive" : "extensive, whole";
}

/** Columns of equal width between bars; the last one ends where it ends. */
std::string table_of(const std::vector<std::vector<std::string>> &rows) {
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto &row : rows)
    for (std::size_t k = 0; k + 1 < row.size(); k++) widths[k] = std::max(widths[k], row[k].size());
  std::string text;
  for (const auto &row : rows)
    for (std::size_t k = 0; k < row.size(); k++)
      text += row[k] + (k + 1 < row.size() ? std::string(widths[k] - row[k].size(), ' ') + " | " : "\n");
  return text;
}

std::string table_of(const Source &source, const std::vector<Line> &lines) {
  std::vector<std::vector<std::string>> rows = {
      {"kind", "index", "name", "unit", "int/extensive", "read as", "meaning"}};
  for (const Line &one : lines) {
    const NamedOutput &output = *one.output;
    rows.push_back(
        {one.kind, one.index, output.name, output.unit, text_of(output.extent), one.read_as, output.meaning});
  }
  std::string text = "Outputs of " + source.description + ", " + source.declared->page() + "\n" + table_of(rows);
  const Outputs &outputs = source.declared->outputs();
  if (!outputs.columns.empty())
    text += "array: i from 1 to " + std::to_string(outputs.rows) + ", one row per " + outputs.row + "\n";
  return text;
}

/** The variables that this command defined, with their formulas: if the compute has changed since, they are replaced.
 */
std::map<std::string, std::string> &defined_here() {
  static std::map<std::string, std::string> formulas;
  return formulas;
}

/** What a variable is, for messages; "" when there is none, it is `formula` already, or this command made it. */
std::string other_meaning(Variable &variable, const std::string &name, const std::string &formula) {
  const int found = variable.find(const_cast<char *>(name.c_str()));
  if (found < 0) return "";
  if (!variable.equalstyle(found)) return "not of style equal";
  const std::string text = (variable.*member_of(TextsOfVariables()))[found][0];
  const auto ours = defined_here().find(name);
  if (ours != defined_here().end() && ours->second == text) return "";
  return text == formula ? "" : "equal to " + text;
}

/** If one of the names is taken, no variable is defined. */
void define(LAMMPS *lmp, const std::vector<Line> &lines, const Arguments &errors) {
  Variable &variable = *lmp->input->variable;
  for (const Line &one : lines) {
    const std::string other = other_meaning(variable, one.variable, one.formula);
    if (!other.empty())
      errors.fail("the variable '" + one.variable + "' for '" + one.formula + "' exists already and is " + other +
                  ": delete it first, or give another 'prefix'");
  }
  for (const Line &one : lines) {
    if (one.variable.empty()) continue;
    const int found = variable.find(const_cast<char *>(one.variable.c_str()));
    if (found >= 0 && (variable.*member_of(TextsOfVariables()))[found][0] == one.formula) continue;
    defined_here()[one.variable] = one.formula;
    std::string name = one.variable, style = "equal", formula = one.formula;
    char *words[] = {&name[0], &style[0], &formula[0]};
    variable.set(3, words);
  }
}

bool may_begin_a_name(const std::string &prefix) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  return !prefix.empty() && std::all_of(prefix.begin(), prefix.end(), plain);
}

}

void OutputsCommand::command(int narg, char **arg) {
  Arguments arguments(lmp, "outputs", 0, narg, arg);
  const std::string id = arguments.word("the ID of a compute or fix");
  std::string prefix = id;
  while (!arguments.done()) {
    arguments.keyword({"prefix"});
    prefix = arguments.word("letters, digits and underscores");
    if (!may_begin_a_name(prefix)) arguments.fail("prefix", "letters, digits and underscores", prefix);
  }
  const Source source = source_of(*modify, id, arguments);
  const std::vector<Line> lines = lines_of(source, prefix);
  define(lmp, lines, arguments);
  if (comm->me != 0) return;
  for (FILE *out : {screen, logfile})
    if (out) fputs(table_of(source, lines).c_str(), out);
}

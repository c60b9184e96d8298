// SPDX-License-Identifier: GPL-2.0-or-later
#include "outputs.h"
#include "compute.h"
#include "fix.h"
#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>
#include <stdexcept>

namespace grainscope {

namespace {

std::string replaced(std::string text, const std::string &word) {
  for (std::size_t at = 0; (at = text.find('*', at)) != std::string::npos; at += word.size()) text.replace(at, 1, word);
  return text;
}

std::string page_of(const std::string &kind, std::string style) {
  std::replace(style.begin(), style.end(), '/', '_');
  return "doc/" + kind + "_" + style + ".md";
}

int flagged_extensive(const NamedOutput &output) { return output.extent == Extent::extensive; }

}

OutputList &OutputList::add(const NamedOutput &one) {
  push_back(one);
  return *this;
}

OutputList &OutputList::add_each(const std::string &words, const NamedOutput &pattern) {
  std::istringstream all(words);
  for (std::string word; all >> word;)
    push_back({replaced(pattern.name, word), pattern.unit, pattern.extent, replaced(pattern.meaning, word)});
  return *this;
}

void Outputs::set_array(int how_many, const std::string &of, const OutputList &list) {
  rows = how_many;
  row = of;
  columns = list;
}

template <class Style>
void DeclaresOutputs::set_flags(Style *style) {
  const Outputs &outputs = outputs_;
  require_good_names();
  if (!outputs.scalar.empty()) {
    style->scalar_flag = 1;
    style->extscalar = flagged_extensive(outputs.scalar[0]);
  }
  if (outputs.vector.empty()) return;
  style->vector_flag = 1;
  style->size_vector = outputs.vector.size();
  for (const NamedOutput &one : outputs.vector) extensive_.push_back(flagged_extensive(one));
  const auto many = std::count(extensive_.begin(), extensive_.end(), 1);
  const bool mixed = many && many != style->size_vector;
  style->extvector = mixed ? -1 : many > 0;
  if (mixed) style->extlist = extensive_.data();
}

void DeclaresOutputs::declare(LAMMPS_NS::Compute *compute, const Outputs &outputs) {
  outputs_ = outputs;
  style_ = compute->style;
  page_ = page_of("compute", style_);
  set_flags(compute);
  if (!outputs.vector.empty()) {
    vector_.assign(outputs.vector.size(), 0.0);
    compute->vector = vector_.data();
  }
  if (!outputs.columns.empty()) {
    compute->array_flag = 1;
    compute->extarray = 0;
    compute->size_array_rows = outputs.rows;
    compute->size_array_cols = outputs.columns.size();
    compute->array = array_ = rows_.resize(outputs.rows, outputs.columns.size());
  }
  const auto width = [](const OutputList &list) { return list.size() == 1 ? 0 : static_cast<int>(list.size()); };
  if (!outputs.per_grain.empty()) {
    compute->peratom_flag = 1;
    compute->size_peratom_cols = width(outputs.per_grain);
  }
  if (!outputs.local.empty()) {
    compute->local_flag = 1;
    compute->size_local_rows = 0;
    compute->size_local_cols = width(outputs.local);
  }
}

void DeclaresOutputs::declare(LAMMPS_NS::Fix *fix, const std::string &style, const Outputs &outputs) {
  outputs_ = outputs;
  style_ = style;
  page_ = page_of("fix", style_);
  set_flags(fix);
}

void DeclaresOutputs::require_good_names() const {
  std::set<std::string> found;
  for (const OutputList *list : {&outputs_.vector, &outputs_.columns, &outputs_.per_grain, &outputs_.local})
    for (const NamedOutput &one : *list) {
      const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
      const bool good = !one.name.empty() && std::all_of(one.name.begin(), one.name.end(), plain);
      const bool repeats = !found.insert(one.name).second && list != &outputs_.per_grain;  // a column asked for twice
      if (!good || repeats)
        throw std::logic_error(style_ + ": '" + one.name +
                               "' cannot name an output: it must be letters, digits and underscores, once");
    }
}

void DeclaresOutputs::require_count(std::size_t given, const OutputList &declared, const char *what) const {
  if (given == declared.size()) return;
  throw std::logic_error(style_ + ": " + std::to_string(given) + " " + what + " are given, " +
                         std::to_string(declared.size()) + " are declared");
}

void DeclaresOutputs::put(const double *values, std::size_t n, double *to, const OutputList &declared,
                          const char *what) const {
  require_count(n, declared, what);
  std::copy(values, values + n, to);
}

}

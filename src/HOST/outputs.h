// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_OUTPUTS_H
#define GRAINSCOPE_OUTPUTS_H

#include "rows.h"
#include <initializer_list>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class Compute;
class Fix;
}

namespace grainscope {

/** How a number grows with the system. `whole`: as extensive, but `thermo_modify norm yes` does not divide it by the
 *  number of grains: a number of contacts is wanted as it is. */
enum class Extent { intensive, extensive, whole };

/** One number that a compute or fix gives, or one column. */
struct NamedOutput {
  std::string name;  // letters, digits and underscores: variables end with it; each once in a style
  std::string unit;  // "-": none
  Extent extent;
  std::string meaning;  // one line
};

/** Numbers or columns in the order of their indices. */
class OutputList : public std::vector<NamedOutput> {
 public:
  OutputList() {}
  OutputList(std::initializer_list<NamedOutput> all) : std::vector<NamedOutput>(all) {}
  OutputList &add(const NamedOutput &one);
  /** One for each of `words`, which stands for the * in its name and meaning: "xx yy zz xy xz yz" and {"s*", ...}. */
  OutputList &add_each(const std::string &words, const NamedOutput &pattern);
};

/** All that a compute or fix gives. */
struct Outputs {
  OutputList scalar;  // one or none; with the name of an element of the vector: the same number
  OutputList vector;
  OutputList columns;  // of the array
  int rows;
  std::string row;  // what one row of the array is
  OutputList per_grain, local;

  Outputs() : rows(0) {}
  void set_array(int how_many, const std::string &of, const OutputList &list);
};

/** A compute or fix that says what it gives, once: flags, sizes and storage for LIGGGHTS and what the command `outputs`
 *  prints follow from that. */
class DeclaresOutputs {
 public:
  virtual ~DeclaresOutputs() {}
  const Outputs &outputs() const { return outputs_; }
  const std::string &declared_style() const { return style_; }
  /** The page that explains them: "doc/compute_stress_contact.md". */
  const std::string &page() const { return page_; }

 protected:
  /** In the constructor. A fix may have another style to LIGGGHTS. */
  void declare(LAMMPS_NS::Compute *compute, const Outputs &outputs);
  void declare(LAMMPS_NS::Fix *fix, const std::string &style, const Outputs &outputs);

  /** All elements of the vector, in the order of the declaration; of a row of the array, likewise. */
  template <std::size_t N>
  void put_vector(const double (&values)[N]) {
    put(values, N, vector_.data(), outputs_.vector, "elements");
  }
  template <std::size_t N>
  void put_row(int row, const double (&values)[N]) {
    put(values, N, array_[row], outputs_.columns, "columns");
  }
  /** For a vector that was written one element after the other: `end` is behind the last. */
  void require_all_elements(const double *end) const {
    require_count(end - vector_.data(), outputs_.vector, "elements");
  }
  /** The same of a row of the array. */
  void require_all_columns(const double *begin, const double *end) const {
    require_count(end - begin, outputs_.columns, "columns");
  }
  /** For what has places of its own. */
  void require_count(std::size_t given, const OutputList &declared, const char *what) const;
  double array_bytes() const { return rows_.bytes(); }

 private:
  Outputs outputs_;
  std::string style_, page_;
  std::vector<double> vector_;
  std::vector<int> extensive_;  // of each element, where they differ
  Rows rows_;
  double **array_ = nullptr;

  template <class Style>
  void set_flags(Style *style);
  void require_good_names() const;
  void put(const double *values, std::size_t n, double *to, const OutputList &declared, const char *what) const;
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_FIELD_QUANTITIES_H
#define GRAINSCOPE_FIELD_QUANTITIES_H

#include "field_sums.h"
#include "outputs.h"
#include <string>
#include <vector>

namespace grainscope {

class Arguments;

/** What turns sums into outputs. */
struct FieldUnits {
  double pressure = 1.0;  // force over area
  double kinetic = 1.0;   // mass velocity^2 over volume
  int dimension = 3;
};

/** Which quantities a field has: what is added up for them, and the columns that follow from the sums of a cell, or of
 *  many samples of it. */
class FieldQuantities {
 public:
  /** Those of these names; errors for one that there is not. */
  FieldQuantities(const Arguments &errors, const std::vector<std::string> &names);

  /** All that there are; with `dimension 2` those that it has. */
  static std::vector<std::string> names(int dimension);
  /** FieldSums::Block, together. */
  unsigned blocks() const { return blocks_; }
  bool need_contacts() const;
  /** After the middle and the volume of the cell; components by r, t, a instead of x, y, z for rings. */
  OutputList columns(bool rings) const;
  /** Writes them; returns the place behind. `samples`: how many times are in the sums. */
  double *write(const FieldSums &sums, int cell, double samples, const FieldUnits &units, double *to) const;
  /** What each of these columns is a ratio to, volume, mass, grains ..., summed: 0 where it means nothing. */
  std::vector<double> below(const FieldSums &sums, int cell) const;

 private:
  struct Quantity;
  static const std::vector<Quantity> &all();
  std::vector<const Quantity *> chosen_;
  unsigned blocks_ = 0;
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_STRAIN_SOURCE_H
#define GRAINSCOPE_STRAIN_SOURCE_H

#include "pointers.h"
#include <string>

namespace LAMMPS_NS { class Fix; }

namespace grainscope {

class Arguments;

/** Where a compute takes the shear strain from: an element of a fix's vector, an equal-style variable, or the strain of the deck's only
 *  fix press/strain. */
class StrainSource : private LAMMPS_NS::Pointers {
 public:
  explicit StrainSource(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  /** Reads what follows the keyword 'strain': f_ID[n] or v_name. */
  void read(Arguments &arguments);
  /** Finds it, or errors in the name of `style`. Before each run: fixes and variables come and go. */
  void init(const std::string &style);
  /** The strain now. Collective. */
  double now() const;

 private:
  std::string text_;          // as given; empty: fix press/strain
  std::string name_;          // of the fix or variable
  int element_ = 0;           // of the fix's vector, from 0
  LAMMPS_NS::Fix *fix_ = nullptr;
  int variable_ = -1;

  void find_press_strain(const Arguments &complaints);
};

}

#endif

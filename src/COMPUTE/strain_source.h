// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_STRAIN_SOURCE_H
#define GRAINSCOPE_STRAIN_SOURCE_H

#include "pointers.h"
#include <string>

namespace LAMMPS_NS {
class Fix;
}

namespace grainscope {

class Arguments;

/** The source of the shear strain of a compute: an element of the vector of a fix, an equal-style variable, or the only
 *  fix press/strain of the input script; or, in its place, the time that has passed. */
class StrainSource : private LAMMPS_NS::Pointers {
 public:
  /** `style` is for messages. */
  StrainSource(LAMMPS_NS::LAMMPS *lmp, const std::string &style) : Pointers(lmp), style_(style) {}

  /** Reads what follows the keyword 'strain': f_ID[n], v_name or time. */
  void read(Arguments &arguments);
  bool is_time() const { return text_ == "time"; }
  /** Finds it, or errors. Before each run: fixes and variables come and go. */
  void init();
  /** The strain now, a finite number; or the time that has passed, which the compute's record knows. Collective. */
  double now(double passed_time);

 private:
  std::string style_;
  std::string text_;  // as given; empty: fix press/strain
  std::string name_;  // of the fix or variable
  int element_ = 0;   // of the fix's vector, from 0
  LAMMPS_NS::Fix *fix_ = nullptr;
  int variable_ = -1;
  bool ready_ = false;

  void find(const Arguments &errors);
  void find_press_strain(const Arguments &errors);
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PRESS_STRAIN_HOST_ARGUMENTS_H
#define GRAINSCOPE_PRESS_STRAIN_HOST_ARGUMENTS_H

#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace grainscope {

/** The command that the host's FixDeform, base class of fix press/strain, is given: a deformation at rate zero of the
 *  box parameters that press/strain moves, with velocities remapped. */
class PressStrainHostArguments {
 public:
  /** `narg` and `arg` of the command fix press/strain. Mistakes in them are left to PressStrainSettings to report. */
  PressStrainHostArguments(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg);
  PressStrainHostArguments(const PressStrainHostArguments &) = delete;

  int size() const { return static_cast<int>(pointers_.size()); }
  /** As the host takes words; it does not write to them. */
  char **words() const { return const_cast<char **>(pointers_.data()); }

 private:
  std::vector<std::string> words_;
  std::vector<char *> pointers_;  // into words_

  void move(const std::string &parameter);
};

}

#endif

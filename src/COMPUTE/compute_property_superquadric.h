// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(property/atom,ComputePropertySuperquadric)

#else

#ifndef LMP_COMPUTE_PROPERTY_SUPERQUADRIC_H
#define LMP_COMPUTE_PROPERTY_SUPERQUADRIC_H

#include "compute_property_atom.h"
#include "outputs.h"
#include <vector>

namespace LAMMPS_NS {

/** The compute property/atom of LIGGGHTS, which knows shapes and orientations of atom style ellipsoid only. With atom
 *  style superquadric it also gives shapex shapey shapez semi-axes [length], quatw quati quatj quatk quaternion from
 *  the frame of the grain to that of the laboratory [-], blockiness1 blockiness2 [-]. Zero outside the group. See
 *  doc/compute_property_atom.md. */
class ComputePropertySuperquadric : public ComputePropertyAtom, public grainscope::DeclaresOutputs {
 public:
  ComputePropertySuperquadric(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  void init() override;
  void compute_peratom() override;

 private:
  std::vector<int> own_;  // for each column, which word of ours it is, or -1

  double value(int word, int i) const;
};

}

#endif
#endif

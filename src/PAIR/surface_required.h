// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SURFACE_REQUIRED_H
#define GRAINSCOPE_SURFACE_REQUIRED_H

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
class PairGran;
}

namespace grainscope {

/** With atom style superquadric: errors unless the pair style, with the words `models`, and every fix wall/gran have a
 *  surface model of superquadrics. Without one LIGGGHTS uses the bounding sphere of each grain. */
void require_surface_models(LAMMPS_NS::LAMMPS *lmp, LAMMPS_NS::PairGran *pair, const std::string &models);

}

#endif

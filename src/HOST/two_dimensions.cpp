// SPDX-License-Identifier: GPL-2.0-or-later
#include "two_dimensions.h"
#include "atom.h"
#include "domain.h"
#include "lammps.h"

namespace grainscope {

void require_axes_of_plane(LAMMPS_NS::LAMMPS *lmp, const Arguments &errors, const std::string &keyword,
                           const std::string &choices, const std::string &got) {
  if (lmp->domain->dimension == 2 && got.find('z') != std::string::npos)
    errors.fail(keyword, choices + " with 'dimension 2'", got);
}

void require_grains_of_dimension(LAMMPS_NS::LAMMPS *lmp, const Arguments &errors) {
  if (lmp->domain->dimension == 2 && lmp->atom->superquadric_flag)
    errors.fail("needs atom_style sphere with 'dimension 2', got 'superquadric': LIGGGHTS has superquadrics in three "
                "dimensions only");
}

}

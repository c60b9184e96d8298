// SPDX-License-Identifier: GPL-2.0-or-later
#include "press_strain_requirements.h"
#include "arguments.h"
#include "contact_law.h"
#include "fix_wall_gran_insitu.h"
#include "pair_gran_insitu.h"
#include "press_strain_settings.h"
#include "domain.h"
#include "fix_wall_gran.h"
#include "group.h"
#include "modify.h"
#include "primitive_wall.h"
#include <cstring>
#include <string>

namespace grainscope {

using LAMMPS_NS::Fix;
using LAMMPS_NS::FixWallGran;
using LAMMPS_NS::PrimitiveWall;

namespace {

/** Evaluated at a point that lies on no axis or face of a wall; PrimitiveWall::axis() of LIGGGHTS is right for
 *  cylinders only. */
bool pushes_along(PrimitiveWall *wall, int axis) {
  double point[3] = {0.1234567891, 0.2345678912, 0.3456789123}, push[3];
  wall->resolveContact(point, 0.0, push);
  return push[axis] != 0.0;
}

}

void PressStrainRequirements::require_controllable_box(const ShearedBox &box) const {
  const int periodic[3] = {domain->xperiodic, domain->yperiodic, domain->zperiodic};
  for (int k = 0; k < 3; k++)
    if (settings_.motions[k].moves() && !periodic[k])
      press_strain_error(lmp, std::string("cannot move box edges along '") + "xyz"[k] +
                                  "': the box must be periodic there" +
                                  (settings_.motions[k].how == BoxMotion::How::mean
                                       ? std::string(" (or keep it: '") + "xyz"[k] + " fixed')"
                                       : std::string()));
  for (const Tilt &tilt : tilts) {
    if (!settings_.motions[tilt.index].given) continue;
    const std::string shear = std::string("'shear ") + tilt.name + "'";
    if (!periodic[tilt.flow] || !periodic[tilt.gradient])
      press_strain_error(lmp, shear + " needs a box periodic along both axes");
    for (const Tilt &other : tilts)
      if (!settings_.motions[other.index].given && !takes_part(other) && box.tilt(other) != 0.0)
        press_strain_error(lmp, "with " + shear + " the tilt " + other.name + " must be 0, got " +
                                    Arguments::text(box.tilt(other)) + " (or keep it: 'shear " + other.name +
                                    " fixed')");
  }
  require_alone();
}

/** A box that is sheared in xy and yz gets the tilt xz. */
bool PressStrainRequirements::takes_part(const Tilt &tilt) const {
  return tilt.index == 4 && settings_.motions[5].given && settings_.motions[3].given;
}

void PressStrainRequirements::require_alone() const {
  for (int k = 0; k < modify->nfix; k++) {
    Fix *fix = modify->fix[k];
    if (fix == fix_ || !fix) continue;
    const std::string which = std::string("(fix ") + fix->id + ")";
    if (!strcmp(fix->style, "deform"))
      press_strain_error(lmp, "another fix already deforms the box " + which +
                                  ": only one fix deform or press/strain at a time");
    if (fix->rigid_flag || strstr(fix->style, "multisphere"))
      press_strain_error(lmp, "does not work with rigid bodies " + which);
    if (strncmp(fix->style, "wall/", 5)) continue;
    for (int edge = 0; edge < 3; edge++)
      if (settings_.motions[edge].moves()) require_no_wall_on_axis(fix, edge);
  }
}

void PressStrainRequirements::require_no_wall_on_axis(Fix *fix, int edge) const {
  const char axis = "xyz"[edge];
  FixWallGran *wall = dynamic_cast<FixWallGran *>(fix);
  if (!wall || wall->is_mesh_wall())
    press_strain_error(lmp, std::string("cannot move a box that holds a wall of style ") + fix->style + " (fix " +
                                fix->id + "): only primitive walls of wall/gran on another axis");
  if (wall->primitiveWall() && pushes_along(wall->primitiveWall(), edge))
    press_strain_error(lmp, std::string("cannot move box edges along '") + axis + "': fix " + fix->id +
                                " is a wall on that axis");
}

void PressStrainRequirements::require_known_stiffness() const {
  if (!settings_.control.automatic || settings_.controlled_modes(domain->dimension).empty()) return;
  const auto require = [this](const ContactLaw &law, const std::string &got) {
    if (!law.knows_stiffness())
      press_strain_error(lmp, std::string("'gain auto' works with the normal models ") + ContactLaw::elastic_models() +
                                  " only: give a number, or change the models of " + got);
  };
  const LAMMPS_NS::PairGranInsitu *pair = LAMMPS_NS::PairGranInsitu::required_by(lmp, "fix press/strain");
  require(pair->law(), "pair_style gran/insitu, got '" + pair->law().models + "'");
  for (const Wall &wall : walls_of(lmp))
    if (wall.law) require(*wall.law, "wall '" + wall.name + "', got '" + wall.law->models + "'");
}

void PressStrainRequirements::require_group(const char *name, int groupbit) const {
  const int found = group->find(name);
  if (found < 0 || group->bitmask[found] != groupbit)
    press_strain_error(lmp, std::string("its group '") + name + "' was deleted: define the group and the fix again");
}

}

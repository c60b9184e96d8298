// SPDX-License-Identifier: GPL-2.0-or-later
#include "surface_required.h"
#include "arguments.h"
#include "atom.h"
#include "fix_wall_gran.h"
#include "modify.h"
#include "pair_gran.h"
#include <sstream>

using namespace LAMMPS_NS;

namespace grainscope {
namespace {

/** The words of a model with `surface` where LIGGGHTS requires it: after the other models, before their settings. */
std::string with_surface(const std::string &models, const std::string &surface) {
  std::istringstream words(models);
  std::string keyword, value, line;
  while (words >> keyword) {
    const bool law = keyword == "model" || keyword == "tangential";
    const bool names_a_model = law || keyword == "cohesion" || keyword == "rolling_friction";
    if (keyword == "surface") words >> value;
    if (!names_a_model) break;
    words >> value;
    line += keyword + " " + value + " ";
  }
  line += "surface " + surface;
  if (keyword != "surface" && words) line += " " + keyword;
  while (words >> keyword) line += " " + keyword;
  return line;
}

/** Of all grains, inserted ones apart. */
std::string surface_for(LAMMPS *lmp) {
  int boxy = 0, any = 0;
  for (int i = 0; i < lmp->atom->nlocal; i++)
    if (lmp->atom->blockiness[i][0] != 2.0 || lmp->atom->blockiness[i][1] != 2.0) boxy = 1;
  MPI_Allreduce(&boxy, &any, 1, MPI_INT, MPI_MAX, lmp->world);
  return any ? "superquadric" : "ellipsoid";
}

/** The surface models of LIGGGHTS for spheres only. */
template <class Style>
const char *sphere_surface(Style *style) {
  for (const char *surface : {"default", "multicontact"})
    if (style->contact_match("surface", surface)) return surface;
  return nullptr;
}

}

void require_surface_models(LAMMPS *lmp, PairGran *pair, const std::string &models) {
  if (!lmp->atom->superquadric_flag) return;
  const std::string why = "grains of atom_style superquadric need a surface model of their shape, or they collide as "
                          "their bounding spheres; got surface '";
  if (const char *got = sphere_surface(pair)) {
    const std::string line = "pair_style gran/insitu " + with_surface(models, surface_for(lmp));
    end_run(lmp, "pair_style gran/insitu: " + why + got + "'. Write '" + line + "'");
  }
  for (int k = 0; k < lmp->modify->nfix; k++) {
    FixWallGran *wall = dynamic_cast<FixWallGran *>(lmp->modify->fix[k]);
    if (!wall || std::string(wall->style).compare(0, 9, "wall/gran") != 0) continue;
    if (const char *got = sphere_surface(wall))
      end_run(lmp, "fix " + std::string(wall->id) + " (" + wall->style + "): " + why + got + "'. Add 'surface " +
                       surface_for(lmp) + "' after its other models");
  }
}

}

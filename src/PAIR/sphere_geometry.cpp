// SPDX-License-Identifier: GPL-2.0-or-later
#include "sphere_geometry.h"
#include "symmetry_axis.h"
#include "atom.h"
#include "fix_wall_gran.h"
#include "pair_gran.h"
#include <functional>

namespace grainscope {

namespace {

using Matches = std::function<bool(const std::string &, const std::string &)>;

/** Two words of the first that matches, or "". */
std::string first_match(const Matches &matches, const std::string &kind, std::initializer_list<const char *> models) {
  for (const char *model : models)
    if (matches(kind, model)) return (kind == "normal" ? "model " : kind + " ") + model;
  return "";
}

std::string area_model(const Matches &matches) {
  const std::string found = first_match(matches, "cohesion", {"sjkr", "sjkr2"});
  return found.empty() ? first_match(matches, "normal", {"edinburgh", "edinburgh/stiffness"}) : found;
}

/** Of whatever name: the area models are the only ones that can be helped. */
std::string other_cohesion(const Matches &matches) {
  if (!first_match(matches, "cohesion", {"off", "sjkr", "sjkr2"}).empty()) return "";
  const std::string known = first_match(matches, "cohesion", {"easo/capillary/viscous", "washino/capillary/viscous"});
  return known.empty() ? "cohesion" : known;
}

bool is_sphere(const double *shape) { return symmetry_axis(shape).shape == Shape::sphere; }

}

void SphereGeometry::connect(LAMMPS_NS::LAMMPS *lmp, LIGGGHTS::IContactHistorySetup *setup) {
  atom_ = lmp->atom;
  Matches matches;
  if (auto *pair = dynamic_cast<LAMMPS_NS::PairGran *>(setup))
    matches = [pair](const std::string &kind, const std::string &model) { return pair->contact_match(kind, model); };
  if (auto *wall = dynamic_cast<LAMMPS_NS::FixWallGran *>(setup))
    matches = [wall](const std::string &kind, const std::string &model) { return wall->contact_match(kind, model); };
  needed_ = matches && !area_model(matches).empty();
  refused_ = matches ? other_cohesion(matches) : "";
}

std::string SphereGeometry::of(LAMMPS_NS::PairGran &pair) {
  const Matches matches = [&pair](const std::string &kind, const std::string &model) {
    return pair.contact_match(kind, model);
  };
  const std::string found = area_model(matches);
  return found.empty() ? other_cohesion(matches) : found;
}

void SphereGeometry::enter(SurfaceData &s) {
  const bool sphere = is_sphere(atom_->shape[s.i]);
  // For two spheres the data of LIGGGHTS are right. For a sphere at a wall they are not: a plane gives the distance for
  // the bounding radius, which is larger, and a mesh leaves the distance of another contact.
  if (!s.is_wall && sphere && is_sphere(atom_->shape[s.j])) return;
  lent_ = true;
  kept_[0] = s.radi;
  kept_[1] = s.radj;
  kept_[2] = s.radsum;
  kept_[3] = s.r;
  if (s.is_wall) {
    if (!sphere) s.radi = s.reff;
    s.radsum = s.radi;
  } else {
    const double ratio = s.reff * (s.radi + s.radj) / (s.radi * s.radj);
    s.radi *= ratio;
    s.radj *= ratio;
    s.radsum = s.radi + s.radj;
  }
  s.r = s.radsum - s.deltan;
}

}

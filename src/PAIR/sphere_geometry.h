// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SPHERE_GEOMETRY_H
#define GRAINSCOPE_SPHERE_GEOMETRY_H

#include "contact_interface.h"
#include <string>

namespace LAMMPS_NS {
class Atom;
class LAMMPS;
class PairGran;
}

namespace grainscope {

/** Models of LIGGGHTS that know spheres only: cohesion sjkr and sjkr2 and the adhesion of the normal model edinburgh
 *  take their contact area from the distance of the centres and the radii. For grains that are not spheres they get two
 *  spheres that touch as the grains do: with the overlap and the effective radius R* of the contact, and radii in the
 *  ratio of those of equal volume. The area of sjkr is then 2 pi R* delta, less the difference that two spheres have
 *  from it at a finite overlap. At a wall they get one sphere of radius R*. Capillary bridges act at a distance, and
 *  are refused. */
class SphereGeometry {
 public:
  using SurfaceData = LIGGGHTS::ContactModels::SurfacesIntersectData;

  /** Once the models of the pair style or wall are known. */
  void connect(LAMMPS_NS::LAMMPS *lmp, LIGGGHTS::IContactHistorySetup *setup);
  bool needed() const { return needed_; }
  /** The words of a model for which this is not possible, or "". */
  const std::string &refused() const { return refused_; }

  void enter(SurfaceData &s);
  /** Restores the data for what follows, and for the next contact of the same grain. */
  void leave(SurfaceData &s) {
    if (!lent_) return;
    lent_ = false;
    s.radi = kept_[0];
    s.radj = kept_[1];
    s.radsum = kept_[2];
    s.r = kept_[3];
  }

  /** The words of a model of this pair style that treats grains as spheres, whatever their shape, or "". */
  static std::string of(LAMMPS_NS::PairGran &pair);

 private:
  const LAMMPS_NS::Atom *atom_ = nullptr;
  bool needed_ = false, lent_ = false;
  std::string refused_;
  double kept_[4] = {0.0, 0.0, 0.0, 0.0};
};

}

#endif

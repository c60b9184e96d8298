// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef SURFACE_MODEL
// clang-format off
SURFACE_MODEL(SURFACE_ELLIPSOID,ellipsoid,11)
// clang-format on
#else
#ifndef GRAINSCOPE_SURFACE_MODEL_ELLIPSOID_H
#define GRAINSCOPE_SURFACE_MODEL_ELLIPSOID_H

#include "ellipsoid_owner.h"
#include "ellipsoid_surface.h"
#include "shown_columns.h"
#include "sphere_geometry.h"
#include "surface_model_superquadric.h"
#include <memory>

namespace LIGGGHTS { namespace ContactModels {

/** Grains of atom_style superquadric with blockiness 2 2, by the exact contact of ellipsoids: `surface superquadric` in
 *  keywords, physics and history columns, walls included; but models that know spheres only are given spheres
 *  (sphere_geometry.h). See doc/surface_ellipsoid.md. */
template <>
class SurfaceModel<SURFACE_ELLIPSOID> : public SurfaceModelBase {
 public:
  SurfaceModel(LAMMPS *lmp, IContactHistorySetup *setup, ContactModelBase *model)
      : SurfaceModelBase(lmp, setup, model), setup_(setup) {
    if (!atom->superquadric_flag)
      error->all(FLERR,
                 "surface ellipsoid needs atom_style superquadric (spheres are ellipsoids with three equal semi-axes)");
    surface_.first = setup->add_history_value("inequality_obb", "0");
    for (const char *name : {"touching", "cpx", "cpy", "cpz", "a1"}) setup->add_history_value(name, "0");
    surface_.lambda = setup->add_history_value("lambda", "1");
    model->add_history_offset("contact_point_offset", surface_.first + 2);
    model->add_history_offset("alpha1_offset", surface_.first + 5);
    model->add_history_offset("alpha2_offset", surface_.first + 6);
    if (model->is_wall()) return;
    owner_ = dynamic_cast<grainscope::EllipsoidOwner *>(setup);
    if (!owner_) own_bodies_.reset(new grainscope::EllipsoidBodies(lmp));
    bodies_ = owner_ ? &owner_->ellipsoid_bodies() : own_bodies_.get();
  }

  void registerSettings(Settings &settings) {
    settings.registerDoubleSetting("curvatureLimitFactor", surface_.curvature_limit, 0.0);
    settings.registerYesNo("meanCurvature", surface_.mean, false);
    settings.registerYesNo("gaussianCurvature", surface_.gaussian, false);
  }

  void postSettings(IContactHistorySetup *, ContactModelBase *) {
    if (!(surface_.curvature_limit >= 0.0)) {
      char message[128];
      snprintf(message, sizeof message, "surface ellipsoid: curvatureLimitFactor must be at least 0, got %g",
               surface_.curvature_limit);
      error->all(FLERR, message);
    }
    if (surface_.mean && surface_.gaussian)
      error->all(
          FLERR,
          "surface ellipsoid: meanCurvature and gaussianCurvature cannot both be yes: the radius is one or the other");
    if (owner_) owner_->ellipsoid_surface() = surface_;
  }

  void connectToProperties(PropertyRegistry &) {
    spheres_.connect(lmp, setup_);
    if (bodies_) bodies_->set_sphere_model(spheres_.refused());
  }

  void beginPass(SurfacesIntersectData &, ForceData &, ForceData &) {
    if (bodies_) bodies_->prepare();
  }

  bool checkSurfaceIntersect(SurfacesIntersectData &s) {
    const grainscope::EllipsoidBodies::Query query{
        s.i, s.j, {-s.delta[0], -s.delta[1], -s.delta[2]}, surface_.start(s.contact_history)};
    const grainscope::EllipsoidContact contact = bodies_->solve(query);
    const bool for_output = !s.computeflag;
    if (for_output) shown_.keep(s.contact_history + surface_.first);
    const bool touching = surface_.enter(contact, s, *bodies_, atom);
    if (touching && for_output) surface_.show(contact, s);
    return touching;
  }

  void surfacesIntersect(SurfacesIntersectData &s, ForceData &, ForceData &) {
    if (s.is_wall) surfacesIntersectWall(s);
    else surface_.move(s, atom);
    if (spheres_.needed() && s.is_non_spherical) spheres_.enter(s);
  }

  void endSurfacesIntersect(SurfacesIntersectData &s, TriMesh *, double *const) { spheres_.leave(s); }
  void surfacesClose(SurfacesCloseData &, ForceData &, ForceData &) {}
  void endPass(SurfacesIntersectData &, ForceData &, ForceData &) { shown_.put_back(); }
  void tally_pp(double, int, int, int) {}
  void tally_pw(double, int, int, int) {}

 private:
  grainscope::EllipsoidSurface surface_;
  grainscope::SphereGeometry spheres_;
  grainscope::ShownColumns<grainscope::EllipsoidSurface::columns> shown_;
  IContactHistorySetup *setup_;
  grainscope::EllipsoidOwner *owner_ = nullptr;
  grainscope::EllipsoidBodies *bodies_ = nullptr;
  std::unique_ptr<grainscope::EllipsoidBodies> own_bodies_;

  void surfacesIntersectWall(SurfacesIntersectData &s) {
    s.reff = s.radi;
    if (surface_.curvature_limit > 0.0) {
      Superquadric grain(atom->x[s.i], atom->quaternion[s.i], atom->shape[s.i], atom->blockiness[s.i]);
      const double curvature = grain.calc_curvature_coefficient(surface_.mean ? 0 : 1, s.contact_point);
      s.reff = MathExtraLiggghtsNonspherical::get_effective_radius_wall(s, atom->blockiness[s.i], curvature,
                                                                        surface_.curvature_limit, error);
    }
    MathExtraLiggghtsNonspherical::surfacesIntersectNonSpherical(s, atom->x);
  }
};

}}

#endif
#endif

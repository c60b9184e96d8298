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
#include "pair_gran.h"
#include "shown_row.h"
#include "sphere_geometry.h"
#include "surface_model_superquadric.h"
#include <memory>

namespace LIGGGHTS { namespace ContactModels {

/** Grains of atom_style superquadric with blockiness 2 2, by the exact contact of ellipsoids. Keywords and physics are
 *  those of `surface superquadric`, walls included; but models that know spheres only are given spheres
 *  (sphere_geometry.h). See doc/surface_ellipsoid.md. */
template <>
class SurfaceModel<SURFACE_ELLIPSOID> : public SurfaceModelBase {
 public:
  SurfaceModel(LAMMPS *lmp, IContactHistorySetup *setup, ContactModelBase *model)
      : SurfaceModelBase(lmp, setup, model), setup_(setup) {
    if (!atom->superquadric_flag)
      error->all(FLERR, (std::string("surface ellipsoid needs atom_style superquadric, got '") + atom->atom_style +
                         "' (a sphere is a superquadric with three equal semi-axes)")
                            .c_str());
    if (model->is_wall())
      for (const char *name : {"inequality_obb", "touching", "cpx", "cpy", "cpz", "a1"})
        setup->add_history_value(name, "0");
    if (setup->add_history_value(Columns::kept, "1") != (model->is_wall() ? Columns::left_out : 0))
      error->all(FLERR, "surface ellipsoid must have the first columns of the contact history");
    model->add_history_offset("contact_point_offset", Columns::contact_point);
    model->add_history_offset("alpha1_offset", Columns::first_depth);
    model->add_history_offset("alpha2_offset", Columns::second_depth);
    if (model->is_wall()) return;
    pair_ = dynamic_cast<PairGran *>(setup);
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
    if (for_output(s)) s.contact_history = shown_.copy(s.contact_history, pair_->dnum());
    const bool touching = surface_.enter(contact, s, *bodies_, atom);
    if (touching && for_output(s)) surface_.show(contact, s, shown_.superquadric_columns());
    return touching;
  }

  void surfacesIntersect(SurfacesIntersectData &s, ForceData &, ForceData &) {
    if (s.is_wall) surfacesIntersectWall(s);
    else surface_.move(s, atom);
    if (spheres_.needed() && s.is_non_spherical) spheres_.enter(s);
  }

  void endSurfacesIntersect(SurfacesIntersectData &s, TriMesh *, double *const) { spheres_.leave(s); }
  void surfacesClose(SurfacesCloseData &s, ForceData &, ForceData &) {
    if (!s.is_wall && for_output(s)) s.contact_history = shown_.copy(s.contact_history, pair_->dnum());
  }
  void endPass(SurfacesIntersectData &, ForceData &, ForceData &) {}
  void tally_pp(double, int, int, int) {}
  void tally_pw(double, int, int, int) {}

 private:
  using Columns = grainscope::SuperquadricColumns;

  grainscope::EllipsoidSurface surface_;
  grainscope::SphereGeometry spheres_;
  grainscope::ShownRow shown_;
  IContactHistorySetup *setup_;
  PairGran *pair_ = nullptr;  // of contacts of grains
  grainscope::EllipsoidOwner *owner_ = nullptr;
  grainscope::EllipsoidBodies *bodies_ = nullptr;
  std::unique_ptr<grainscope::EllipsoidBodies> own_bodies_;

  static bool for_output(const SurfacesCloseData &s) { return !s.computeflag; }

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

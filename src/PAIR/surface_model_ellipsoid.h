// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef SURFACE_MODEL
SURFACE_MODEL(SURFACE_ELLIPSOID,ellipsoid,11)
#else
#ifndef GRAINSCOPE_SURFACE_MODEL_ELLIPSOID_H
#define GRAINSCOPE_SURFACE_MODEL_ELLIPSOID_H

#include "ellipsoid_bodies.h"
#include "surface_model_superquadric.h"
#include <memory>

namespace LIGGGHTS {
namespace ContactModels {

/** Grains of atom_style superquadric with blockiness 2 2, by the exact contact of ellipsoids: `surface superquadric` in keywords,
 *  physics and history columns (so that restart files of the two are interchangeable), walls included. See doc/surface_ellipsoid.md. */
template <>
class SurfaceModel<SURFACE_ELLIPSOID> : public SurfaceModelBase {
 public:
  SurfaceModel(LAMMPS *lmp, IContactHistorySetup *setup, ContactModelBase *model) : SurfaceModelBase(lmp, setup, model) {
    if (!atom->superquadric_flag)
      error->all(FLERR, "surface ellipsoid needs atom_style superquadric (spheres are ellipsoids with three equal semi-axes)");
    lambda_ = setup->add_history_value("lambda", "1");  // less 1/2: changes its sign when the host swaps i and j
    state_ = setup->add_history_value("particles_were_in_contact", "0");
    point_ = setup->add_history_value("cpx", "0");
    setup->add_history_value("cpy", "0");
    setup->add_history_value("cpz", "0");
    depth_i_ = setup->add_history_value("a1", "0");
    depth_j_ = setup->add_history_value("a2", "0");
    model->add_history_offset("contact_point_offset", point_);
    model->add_history_offset("alpha1_offset", depth_i_);
    model->add_history_offset("alpha2_offset", depth_j_);
    if (model->is_wall()) return;
    grainscope::EllipsoidBodiesOwner *owner = dynamic_cast<grainscope::EllipsoidBodiesOwner *>(setup);
    if (!owner) own_.reset(new grainscope::EllipsoidBodies(lmp));
    bodies_ = owner ? &owner->ellipsoid_bodies() : own_.get();
  }

  void registerSettings(Settings &settings) {
    settings.registerDoubleSetting("curvatureLimitFactor", curvature_limit_, 0.0);
    settings.registerYesNo("meanCurvature", mean_, false);
    settings.registerYesNo("gaussianCurvature", gaussian_, false);
  }

  void postSettings(IContactHistorySetup *, ContactModelBase *) {
    if (!(curvature_limit_ >= 0.0)) {
      char message[128];
      snprintf(message, sizeof message, "surface ellipsoid: curvatureLimitFactor must be at least 0, got %g", curvature_limit_);
      error->all(FLERR, message);
    }
    if (mean_ && gaussian_)
      error->all(FLERR, "surface ellipsoid: meanCurvature and gaussianCurvature cannot both be yes: the radius is one or the other");
  }

  void connectToProperties(PropertyRegistry &) {}

  void beginPass(SurfacesIntersectData &, ForceData &, ForceData &) { bodies_->prepare(); }

  /** True if grains i and j touch; else deltan is minus a lower bound of their distance. */
  bool checkSurfaceIntersect(SurfacesIntersectData &s) {
    s.is_non_spherical = true;
    double *history = s.contact_history;
    const double d[3] = {-s.delta[0], -s.delta[1], -s.delta[2]};
    const double start = history[state_] == TOUCHING ? history[lambda_] + 0.5 : 0.0;
    const grainscope::EllipsoidContact c = bodies_->contact(s.i, s.j, d, start);
    history[state_] = c.touching ? TOUCHING : FAR;
    if (!c.touching) {
      s.deltan = -c.gap;
      return false;
    }
    history[lambda_] = c.lambda - 0.5;
    history[depth_i_] = c.depth[0];
    history[depth_j_] = c.depth[1];
    s.deltan = c.depth[0] + c.depth[1];
    s.reff = s.radi * s.radj / (s.radi + s.radj);
    double on_i[3], on_j[3];
    for (int k = 0; k < 3; k++) {
      s.en[k] = -c.normal[k];
      s.delta[k] = s.deltan * s.en[k];
      s.contact_point[k] = history[point_ + k] = atom->x[s.i][k] + c.point[k];
      on_i[k] = c.point[k] + c.depth[0] * c.normal[k];
      on_j[k] = c.point[k] - d[k] - c.depth[1] * c.normal[k];
    }
    if (curvature_limit_ > 0.0)
      s.reff = MathExtraLiggghtsNonspherical::get_effective_radius(s, atom->blockiness[s.i], atom->blockiness[s.j],
                                                                   bodies_->curvature(s.i, on_i, mean_),
                                                                   bodies_->curvature(s.j, on_j, mean_), curvature_limit_, error);
    return true;
  }

  void surfacesIntersect(SurfacesIntersectData &s, ForceData &, ForceData &) {
    if (s.is_wall) {
      s.reff = s.radi;
      if (curvature_limit_ > 0.0) {
        Superquadric grain(atom->x[s.i], atom->quaternion[s.i], atom->shape[s.i], atom->blockiness[s.i]);
        s.reff = MathExtraLiggghtsNonspherical::get_effective_radius_wall(
            s, atom->blockiness[s.i], grain.calc_curvature_coefficient(mean_ ? 0 : 1, s.contact_point), curvature_limit_, error);
      }
    }
    MathExtraLiggghtsNonspherical::surfacesIntersectNonSpherical(s, atom->x);
  }

  void endSurfacesIntersect(SurfacesIntersectData &, TriMesh *, double *const) {}
  void surfacesClose(SurfacesCloseData &, ForceData &, ForceData &) {}
  void endPass(SurfacesIntersectData &, ForceData &, ForceData &) {}
  void tally_pp(double, int, int, int) {}
  void tally_pw(double, int, int, int) {}

 private:
  enum { FAR = 0, TOUCHING = 2 };  // as `surface superquadric` writes them
  int lambda_, state_, point_, depth_i_, depth_j_;
  double curvature_limit_ = 0.0;
  bool mean_ = false, gaussian_ = false;
  grainscope::EllipsoidBodies *bodies_ = nullptr;
  std::unique_ptr<grainscope::EllipsoidBodies> own_;
};

}
}

#endif
#endif

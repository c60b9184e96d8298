// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_OBSERVED_CONTACT_MODEL_H
#define GRAINSCOPE_OBSERVED_CONTACT_MODEL_H

#include "contact_observer.h"
#include "pair_gran_insitu.h"
#include "contact_models.h"

namespace grainscope {

/** A LIGGGHTS contact model with the observer around it. It shadows two members of the model that the host's pair loop calls, so
 *  the loop stays the host's own. It also restores sidata.delta = x_i - x_j, which the surface model of non-spherical grains
 *  overwrites with the overlap vector and the host's virial then takes for the branch vector. */
template <class ContactModel>
class Observed : public ContactModel {
 public:
  Observed(LAMMPS_NS::LAMMPS *lmp, LIGGGHTS::IContactHistorySetup *setup, bool is_wall, const int64_t hash)
      : ContactModel(lmp, setup, is_wall, hash), x_(&lmp->atom->x),
        observer_(static_cast<LAMMPS_NS::PairGranInsitu *>(static_cast<LAMMPS_NS::PairGran *>(setup))->observer()) {
    newest() = this;
  }

  /** The host's loop keeps its model to itself; a loop of ours asks here, right after it was made. */
  static Observed *&newest() {
    static Observed *model = nullptr;
    return model;
  }

  using Sides = LIGGGHTS::ContactModels::SurfacesIntersectData;
  using Force = LIGGGHTS::ContactModels::ForceData;

  void surfacesIntersect(Sides &s, Force &i, Force &j) {
    if (observer_.active()) observer_.remember_spring(s);
    ContactModel::surfacesIntersect(s, i, j);
  }

  void endSurfacesIntersect(Sides &s, LAMMPS_NS::TriMesh *mesh, Force &i, Force &j) {
    ContactModel::endSurfacesIntersect(s, mesh, i, j);
    if (s.is_non_spherical)
      for (int k = 0; k < 3; k++) s.delta[k] = (*x_)[s.i][k] - (*x_)[s.j][k];
    if (observer_.active()) observer_.observe(s, i);
  }

 private:
  double ***x_;
  ContactObserver &observer_;
};

}

#endif

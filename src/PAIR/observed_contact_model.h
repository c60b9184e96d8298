// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_OBSERVED_CONTACT_MODEL_H
#define GRAINSCOPE_OBSERVED_CONTACT_MODEL_H

#include "contact_reader.h"
#include "pair_gran_insitu.h"
#include "contact_models.h"

namespace grainscope {

/** A LIGGGHTS contact model with a reader around it. It shadows two members of the model that the host's pair loop
 *  calls, so the loop stays the host's own. It also restores sidata.delta = x_i - x_j, which the surface model of
 *  non-spherical grains overwrites with the overlap vector and the host's virial then takes for the branch vector. */
template <class ContactModel>
class Observed : public ContactModel, public ObservedModel {
 public:
  using Surfaces = ContactReader::Surfaces;
  using Forces = ContactReader::Forces;

  Observed(LAMMPS_NS::LAMMPS *lmp, LIGGGHTS::IContactHistorySetup *setup, bool is_wall, const int64_t hash)
      : ContactModel(lmp, setup, is_wall, hash), x_(&lmp->atom->x),
        reader_(static_cast<LAMMPS_NS::PairGranInsitu *>(static_cast<LAMMPS_NS::PairGran *>(setup))->reader()),
        observer_(reader_.observer()) {
    reader_.set_model(this);  // the host's loop keeps its model to itself
  }

  void surfacesIntersect(Surfaces &s, Forces &i, Forces &j) {
    if (observer_.active()) reader_.before(s);
    ContactModel::surfacesIntersect(s, i, j);
  }

  void endSurfacesIntersect(Surfaces &s, LAMMPS_NS::TriMesh *mesh, Forces &i, Forces &j) {
    ContactModel::endSurfacesIntersect(s, mesh, i, j);
    if (s.is_non_spherical)
      for (int k = 0; k < 3; k++) s.delta[k] = (*x_)[s.i][k] - (*x_)[s.j][k];
    if (observer_.active()) reader_.after(s, i);
  }

 private:
  double ***x_;
  ContactReader &reader_;
  const ContactObserver &observer_;
};

}

#endif

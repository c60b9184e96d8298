// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_OBSERVED_CONTACT_MODEL_H
#define GRAINSCOPE_OBSERVED_CONTACT_MODEL_H

#include "contact_reader.h"
#include "pair_gran_insitu.h"
#include "time_level.h"
#include "contact_models.h"

namespace grainscope {

/** A contact model of LIGGGHTS with a reader around it. It shadows the members of the model that the pair loop of
 *  LIGGGHTS calls, so that the loop itself is unchanged. It also restores sidata.delta = x_i - x_j, which the surface
 *  model of non-spherical grains overwrites with the overlap vector; the virial of LIGGGHTS uses it as the branch
 *  vector. */
template <class ContactModel>
class Observed : public ContactModel, public ObservedModel {
 public:
  using Surfaces = ContactReader::Surfaces;
  using Forces = ContactReader::Forces;

  Observed(LAMMPS_NS::LAMMPS *lmp, LIGGGHTS::IContactHistorySetup *setup, bool is_wall, const int64_t hash)
      : ContactModel(lmp, setup, is_wall, hash), x_(&lmp->atom->x),
        style_(*static_cast<LAMMPS_NS::PairGranInsitu *>(static_cast<LAMMPS_NS::PairGran *>(setup))),
        reader_(style_.reader()), observer_(reader_.observer()), level_(style_.time_level()) {
    reader_.set_model(this);  // the host's loop keeps its model to itself
  }

  void surfacesIntersect(Surfaces &s, Forces &i, Forces &j) {
    if (level_.synchronized()) level_.enter(s);
    if (observer_.active()) reader_.before(s);
    ContactModel::surfacesIntersect(s, i, j);
    if (level_.synchronized()) level_.leave(s);
  }

  void endSurfacesIntersect(Surfaces &s, LAMMPS_NS::TriMesh *mesh, Forces &i, Forces &j) {
    ContactModel::endSurfacesIntersect(s, mesh, i, j);
    if (s.is_non_spherical)
      for (int k = 0; k < 3; k++) s.delta[k] = (*x_)[s.i][k] - (*x_)[s.j][k];
    if (observer_.active()) reader_.after(s, i);
  }

  void surfacesClose(LIGGGHTS::ContactModels::SurfacesCloseData &s, Forces &i, Forces &j) {
    ContactModel::surfacesClose(s, i, j);
    if (level_.synchronized()) level_.forget(s.contact_history);
  }

 private:
  double ***x_;
  LAMMPS_NS::PairGranInsitu &style_;
  ContactReader &reader_;
  const ContactObserver &observer_;
  TimeLevel &level_;
};

}

#endif

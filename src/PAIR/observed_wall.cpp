// SPDX-License-Identifier: GPL-2.0-or-later
#include "observed_wall.h"
#include "wall_contacts_owner.h"
#include "contact_models.h"
#include "fix_wall_gran_base.h"
#include <unordered_map>

namespace grainscope {

using LIGGGHTS::ContactModels::ContactModel;
using LIGGGHTS::ContactModels::GranStyle;
using LIGGGHTS::Walls::IGranularWall;

namespace {

/** The same as Observed, for a wall: the model shadows what the wall of LIGGGHTS calls. sidata.delta is left unchanged,
 *  because meshes sum their torque with it. */
template <class Model>
class ObservedWall : public Model {
 public:
  using Surfaces = ContactReader::Surfaces;
  using Forces = ContactReader::Forces;

  ObservedWall(LAMMPS_NS::LAMMPS *lmp, LIGGGHTS::IContactHistorySetup *setup, bool is_wall, const int64_t hash)
      : Model(lmp, setup, is_wall, hash), wall_(contacts_of(setup)) {}

  void connectToProperties(PropertyRegistry &registry) {
    Model::connectToProperties(registry);
    wall_.exponent = Model::stressStrainExponent();
  }

  void surfacesIntersect(Surfaces &s, Forces &i, Forces &j) {
    if (wall_.level) wall_.level->enter(s);
    if (wall_.reader) wall_.reader->before(s);
    Model::surfacesIntersect(s, i, j);
    if (wall_.level) wall_.level->leave(s);
  }

  void endSurfacesIntersect(Surfaces &s, LAMMPS_NS::TriMesh *mesh, Forces &i, Forces &j) {
    Model::endSurfacesIntersect(s, mesh, i, j);
    if (wall_.reader) wall_.reader->after_wall(s, i, wall_.partner(s));
  }

  void surfacesClose(LIGGGHTS::ContactModels::SurfacesCloseData &s, Forces &i, Forces &j) {
    Model::surfacesClose(s, i, j);
    if (wall_.level) wall_.level->forget(s.contact_history);
  }

 private:
  WallContacts &wall_;

  /** For a fix that is not ours, the contacts are not seen. */
  static WallContacts &contacts_of(LIGGGHTS::IContactHistorySetup *setup) {
    static WallContacts unseen;
    WallContactsOwner *owner = dynamic_cast<WallContactsOwner *>(setup);
    return owner ? owner->wall_contacts() : unseen;
  }
};

using Creator = IGranularWall *(*)(LAMMPS_NS::LAMMPS *, LAMMPS_NS::FixWallGran *, int64_t);

template <class Style>
IGranularWall *create(LAMMPS_NS::LAMMPS *lmp, LAMMPS_NS::FixWallGran *wall, int64_t hash) {
  return new LIGGGHTS::Walls::Granular<ObservedWall<ContactModel<Style>>>(lmp, wall, hash);
}

const std::unordered_map<int64_t, Creator> &compiled() {
  using namespace LIGGGHTS::ContactModels;
  static const std::unordered_map<int64_t, Creator> walls = {
#define GRAN_MODEL(N, T, C, R, S) {int64_t(GranStyle<N, T, C, R, S>::HASHCODE), &create<GranStyle<N, T, C, R, S>>},
#include "style_contact_model.h"
#undef GRAN_MODEL
      {int64_t(GranStyle<>::HASHCODE), &create<GranStyle<>>}};
  return walls;
}

}

IGranularWall *create_observed_wall(int64_t hash, LAMMPS_NS::LAMMPS *lmp, LAMMPS_NS::FixWallGran *wall) {
  const auto found = compiled().find(hash);
  return (found != compiled().end() ? found->second : &create<GranStyle<>>)(lmp, wall, hash);
}

std::vector<int64_t> observed_walls() {
  std::vector<int64_t> hashes;
  for (const auto &one : compiled()) hashes.push_back(one.first);
  return hashes;
}

}

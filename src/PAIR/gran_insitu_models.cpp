// SPDX-License-Identifier: GPL-2.0-or-later
#include "gran_insitu_models.h"
#include "ellipsoid_loop.h"
#include "sphere_loop.h"
#include "granular_styles.h"
#include <unordered_map>

namespace grainscope {

using LIGGGHTS::ContactModels::ContactModel;
using LIGGGHTS::ContactModels::GranStyle;
using LIGGGHTS::PairStyles::IGranularPairStyle;

namespace {

using Creator = IGranularPairStyle *(*)(LAMMPS_NS::LAMMPS *, LAMMPS_NS::PairGran *, int64_t);

/** Cohesion acts on grains that do not touch: every neighbour must be looked at. The Style of a combination that is not
 *  compiled tells nothing of it, its hash does. */
bool cohesive(int64_t hash) {
  constexpr int shift = 12, bits = 6;  // as in GranStyle
  return ((hash >> shift) & ((1 << bits) - 1)) != LIGGGHTS::ContactModels::COHESION_OFF;
}

template <class Style>
IGranularPairStyle *create(LAMMPS_NS::LAMMPS *lmp, LAMMPS_NS::PairGran *pair, int64_t hash) {
  using namespace LIGGGHTS::ContactModels;
  using Model = Observed<ContactModel<Style>>;
  if (!cohesive(hash)) {
    if constexpr (int(Style::SURFACE) == int(SURFACE_ELLIPSOID)) return new EllipsoidLoop<Model>(lmp, pair, hash);
    else if constexpr (int(Style::SURFACE) == int(SURFACE_DEFAULT)) return new SphereLoop<Model>(lmp, pair, hash);
  }
  return new LIGGGHTS::PairStyles::Granular<Model>(lmp, pair, hash);
}

std::unordered_map<int64_t, Creator> compiled_loops() {
  using namespace LIGGGHTS::ContactModels;
  std::unordered_map<int64_t, Creator> loops;
#define GRAN_MODEL(N, T, C, R, S) \
  loops[int64_t(GranStyle<N, T, C, R, S>::HASHCODE)] = &create<GranStyle<N, T, C, R, S>>;
#include "style_contact_model.h"
#undef GRAN_MODEL
  return loops;
}

}

IGranularPairStyle *create_observed_loop(int64_t hash, LAMMPS_NS::LAMMPS *lmp, LAMMPS_NS::PairGran *pair) {
  static const std::unordered_map<int64_t, Creator> loops = compiled_loops();
  const auto found = loops.find(hash);
  return (found != loops.end() ? found->second : &create<GranStyle<>>)(lmp, pair, hash);
}

}

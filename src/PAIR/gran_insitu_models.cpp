// SPDX-License-Identifier: GPL-2.0-or-later
#include "gran_insitu_models.h"
#include "ellipsoid_loop.h"
#include "sphere_loop.h"
#include "granular_styles.h"
#include <algorithm>
#include <initializer_list>
#include <type_traits>
#include <unordered_map>

namespace grainscope {

using LIGGGHTS::ContactModels::ContactModel;
using LIGGGHTS::ContactModels::GranStyle;
using LIGGGHTS::PairStyles::IGranularPairStyle;

namespace {

using Creator = IGranularPairStyle *(*)(LAMMPS_NS::LAMMPS *, LAMMPS_NS::PairGran *, int64_t);

/** The models of a combination, as GranStyle puts them into its hash. That of one that is not compiled has a Style that
 *  tells nothing. */
struct Models {
  int normal, tangential, cohesion, rolling, surface;
  explicit Models(int64_t hash)
      : normal(hash & 63), tangential(hash >> 6 & 63), cohesion(hash >> 12 & 63), rolling(hash >> 18 & 63),
        surface(hash >> 24 & 63) {}

  /** Grains that separate exert no force: only pairs that touch need be visited. Cohesion, and some normal models, act
   *  at a distance. */
  bool end_with_touch() const {
    using namespace LIGGGHTS::ContactModels;
    return cohesion == COHESION_OFF && one_of(normal, {HERTZ, HOOKE, HERTZ_STIFFNESS, HOOKE_STIFFNESS}) &&
           one_of(tangential, {TANGENTIAL_OFF, TANGENTIAL_NO_HISTORY, TANGENTIAL_HISTORY}) &&
           one_of(rolling, {ROLLING_OFF, ROLLING_CDT, ROLLING_EPSD, ROLLING_EPSD2});
  }

 private:
  static bool one_of(int model, std::initializer_list<int> models) {
    return std::find(models.begin(), models.end(), model) != models.end();
  }
};

template <class Style>
IGranularPairStyle *create(LAMMPS_NS::LAMMPS *lmp, LAMMPS_NS::PairGran *pair, int64_t hash) {
  using namespace LIGGGHTS::ContactModels;
  using Model = Observed<ContactModel<Style>>;
  constexpr bool compiled = !std::is_same_v<Style, GranStyle<>>;
  const Models models(hash);
  if (models.end_with_touch()) {
    if constexpr (!compiled || int(Style::SURFACE) == int(SURFACE_ELLIPSOID))
      if (models.surface == SURFACE_ELLIPSOID) return new EllipsoidLoop<Model>(lmp, pair, hash);
    if constexpr (!compiled || int(Style::SURFACE) == int(SURFACE_DEFAULT))
      if (models.surface == SURFACE_DEFAULT) return new SphereLoop<Model>(lmp, pair, hash);
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

// SPDX-License-Identifier: GPL-2.0-or-later
// What our styles need of the host and some of its forks lack, each by name. CheckHost.cmake compiles this against a
// host's headers and reads from the compiler's output what is missing; it never runs.
#include "mpi.h"
#include <type_traits>

namespace LIGGGHTS { namespace ContactModels {
struct SurfacesIntersectData;
}}  // a fork may not define it
#include "contact_interface.h"
#include "fix.h"
#include "force.h"
#include "granular_pair_style.h"
#include "irregular.h"
#include "pair_gran.h"

namespace {

using namespace LAMMPS_NS;
using LIGGGHTS::ContactModels::SurfacesIntersectData;
using LIGGGHTS::PairStyles::Factory;
using LIGGGHTS::PairStyles::IGranularPairStyle;
extern int argc;
extern char **argv;

template <class Object>
using Class = std::decay_t<Object>;
template <class Object, class Use>
constexpr bool allows(Use) {
  return std::is_invocable_v<Use, Object &>;
}

// `use` is an expression in `x`, an object of `type`.
#define NEED(type, use, words) \
  static_assert(allows<type>([](auto &x) -> decltype(void(use)) {}), "host probe: " words "|")
// Exactly this signature, as an overriding member wants it.
#define NEED_MEMBER(type, name, returns, arguments, words) \
  NEED(type, static_cast<returns(Class<decltype(x)>::*) arguments>(&Class<decltype(x)>::name), words)

NEED(SurfacesIntersectData, (x.contact_history, x.delta[0], x.Fn), "contact_interface.h has no SurfacesIntersectData");
NEED_MEMBER(PairGran, compute_pgl, void, (int, int), "pair_gran.h has no compute_pgl");
NEED(const PairGran, x.cpl(), "pair_gran.h has no public cpl() const");
NEED_MEMBER(IGranularPairStyle, compute_force, void, (PairGran *, int, int, int),
            "granular_pair_style.h: compute_force does not take addflag");
NEED_MEMBER(Fix, restart, void, (char *), "fix.h: restart does not take (char *) alone");
NEED_MEMBER(Pair, read_restart_settings, void, (FILE *, int, int),
            "pair.h: read_restart_settings does not take (FILE *, int, int)");
NEED(Irregular, x.migrate_atoms(), "irregular.h has no public migrate_atoms()");
NEED(Force, Factory::instance().selectVariant("", argc, argv, x.custom_contact_models),
     "utils.h: selectVariant does not take custom_contact_models");

}

#include "our_headers.h"  // every member of ours that overrides one of the host's

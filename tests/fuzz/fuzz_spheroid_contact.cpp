// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_checks.h"
#include "side_by_side.h"
#include <cmath>
#include <vector>

using namespace grainscope;
using fuzz::require;

namespace {

Spheroid any_spheroid(fuzz::Input &input) {
  double semi[3], quaternion[4];
  for (double &s : semi) s = std::fabs(input.any());
  if (input.flag()) semi[1] = semi[0];
  for (double &q : quaternion) q = input.any();
  return make_spheroid(semi, quaternion);
}

/** Squares of lengths that have all their digits. */
bool is_normal(const Spheroid &s) {
  return std::isnormal(s.equatorial_square) && std::isnormal(s.polar_square) &&
         std::isnormal(s.inverse_equatorial_square) && std::isnormal(s.inverse_polar_square);
}

bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b)); }

void require_same(const EllipsoidContact &a, const EllipsoidContact &b) {
  require(a.touching == b.touching && a.fallback == b.fallback && a.steps == b.steps,
          "alone or side by side, the same decisions");
  require(same(a.lambda, b.lambda) && same(a.gap, b.gap), "alone or side by side, the same lambda and gap");
  for (int k = 0; k < 3; k++)
    require(same(a.normal[k], b.normal[k]) && same(a.point[k], b.point[k]), "alone or side by side, the same contact");
  for (int k = 0; k < 2; k++)
    require(same(a.depth[k], b.depth[k]) && same(a.curvature[k], b.curvature[k]),
            "alone or side by side, the same depths");
}

}

/** Several pairs, each of a sheared packing or of nothing that makes sense: sound answers, and the same from one pair
 *  and from many. */
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzz::Input input(data, size);
  const int n = input.whole(1, 11);
  std::vector<SideBySide::Query> queries(n);
  for (SideBySide::Query &pair : queries) {
    if (input.byte() < 96) {
      pair.one = any_spheroid(input);
      pair.two = any_spheroid(input);
      for (double &x : pair.d) x = input.any();
      pair.start = input.any();
    } else {
      const GrainPair grains = fuzz::grain_pair(input, false);
      make(grains, 0, pair.one);
      make(grains, 1, pair.two);
      std::copy(grains.d, grains.d + 3, pair.d);
      pair.start = input.flag() ? 0.0 : input.uniform(0.0, 1.0);
      double aside[3];
      input.direction(aside, 3);
      fuzz::check_pair<Spheroid>(grains, pair.start, aside);
    }
  }
  SideBySide many(queries);
  const std::vector<EllipsoidContact> contacts = many.contacts();
  for (int p = 0; p < n; p++) {
    const SideBySide::Query &pair = many.queries()[p];
    // without all digits, what the kernel itself demands of a normal
    fuzz::require_sound(contacts[p], is_normal(pair.one) && is_normal(pair.two) ? 1e-13 : 1e-9);
    require_same(contacts[p], ellipsoid_contact(pair.one, pair.two, pair.d, pair.start));
  }
  return 0;
}

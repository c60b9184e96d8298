// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_checks.h"

using namespace grainscope;

namespace {

Triaxial any_triaxial(fuzz::Input &input) {
  double semi[3], quaternion[4];
  for (double &s : semi) s = std::fabs(input.any());
  for (double &q : quaternion) q = input.any();
  return make_triaxial(semi, quaternion);
}

}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzz::Input input(data, size);
  if (input.byte() < 64) {
    const Triaxial one = any_triaxial(input), two = any_triaxial(input);
    const double d[3] = {input.any(), input.any(), input.any()};
    fuzz::require_sound(ellipsoid_contact(one, two, d, input.any()));
    return 0;
  }
  const bool triaxial = input.flag();
  const GrainPair pair = fuzz::grain_pair(input, triaxial);
  const double start = input.flag() ? 0.0 : input.uniform(0.0, 1.0);
  double aside[3];
  input.direction(aside, 3);
  fuzz::check_pair<Triaxial>(pair, start, aside);
  if (triaxial) return 0;
  fuzz::require_alike(pair, kernel_contact<Triaxial>(pair), kernel_contact<Spheroid>(pair), false,
                      "a spheroid is a triaxial body too");
  return 0;
}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_law.h"

namespace grainscope {

namespace {

const std::string known_tangential = "'tangential' off, no_history and history only";

}

std::string ContactLaw::why_no_losses() const {
  if (!knows_sliding()) return "knows the friction of " + known_tangential;
  if (!elastic) return std::string("knows the damping of the normal models ") + elastic_models() + " only";
  return "";
}

std::string ContactLaw::why_no_energy() const {
  const std::string got = ", got '" + models + "'";
  if (!elastic) return std::string("knows the energy of the normal models ") + elastic_models() + " only" + got;
  if (!knows_sliding()) return "knows the energy of " + known_tangential + got;
  if (cohesive) return "does not know the energy of cohesion: only 'cohesion off'" + got;
  if (rolls && !known_rolling) return "knows the work of 'rolling_friction' off, cdt, epsd and epsd2 only" + got;
  if (!known_surface) return "knows 'surface' default, superquadric and ellipsoid only" + got;
  return "";
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_law.h"

namespace grainscope {

namespace {

const std::string known_tangential = "'tangential' off, no_history and history only";

}

std::string ContactLaw::why_no_losses() const {
  const std::string got = ", got '" + models + "'";
  if (!knows_sliding()) return "works with " + known_tangential + got;
  if (!elastic) return std::string("works with the normal models ") + elastic_models() + " only" + got;
  return "";
}

std::string ContactLaw::why_no_energy() const {
  const std::string got = ", got '" + models + "'";
  if (!elastic) return std::string("works with the normal models ") + elastic_models() + " only" + got;
  if (!knows_sliding()) return "works with " + known_tangential + got;
  if (cohesive) return "works with 'cohesion off' only" + got;
  if (rolls && !known_rolling) return "works with 'rolling_friction' off, cdt, epsd and epsd2 only" + got;
  if (!known_surface) return "works with 'surface' default, superquadric and ellipsoid only" + got;
  return "";
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "model_names.h"
#include <initializer_list>

namespace grainscope {

ContactLaw law_of_models(const std::string &models, const HasModel &has) {
  const auto any = [&has](const char *kind, std::initializer_list<const char *> names) {
    for (const char *name : names)
      if (has(kind, name)) return true;
    return false;
  };
  ContactLaw law;
  law.models = models;
  if (has("tangential", "off")) law.tangential = TangentialLaw::none;
  else if (has("tangential", "no_history")) law.tangential = TangentialLaw::viscous;
  else if (has("tangential", "history")) law.tangential = TangentialLaw::spring;
  law.elastic = any("normal", {"hertz", "hooke", "hertz/stiffness", "hooke/stiffness"});
  law.limits_force = models.find("limitForce on") != std::string::npos;
  law.cohesive = !has("cohesion", "off");
  law.liquid_bridges = any("cohesion", {"washino/capillary/viscous", "easo/capillary/viscous"});
  law.rolls = !has("rolling_friction", "off");
  law.known_rolling = any("rolling_friction", {"cdt", "epsd", "epsd2"});
  law.known_surface = any("surface", {"default", "superquadric", "ellipsoid"});
  return law;
}

}

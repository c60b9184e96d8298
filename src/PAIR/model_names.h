// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_MODEL_NAMES_H
#define GRAINSCOPE_MODEL_NAMES_H

#include "contact_law.h"
#include <functional>
#include <string>

namespace grainscope {

/** Whether the contact models of a pair style or wall have model `name` of `kind`, as in ("normal", "hertz"). */
using HasModel = std::function<bool(const char *kind, const char *name)>;

/** What follows from the names of the models alone; what depends on numbers and columns is left at its default.
 *  `models`: the words of the command. */
ContactLaw law_of_models(const std::string &models, const HasModel &has);

}

#endif

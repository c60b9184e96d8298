// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_NEAREST_NAME_H
#define GRAINSCOPE_NEAREST_NAME_H

#include <string>
#include <vector>

namespace grainscope {

/** ": did you mean 'fabric'?", of `names` the one that differs from `name` by the fewest letters; nothing where none is
 *  near. */
std::string nearest_name(const std::string &name, const std::vector<std::string> &names);

}

#endif

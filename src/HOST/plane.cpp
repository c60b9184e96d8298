// SPDX-License-Identifier: GPL-2.0-or-later
#include "plane.h"
#include "arguments.h"
#include "two_dimensions.h"

namespace grainscope {

void Plane::read(Arguments &arguments) {
  const std::string name = arguments.choice("plane", {"xy", "xz", "yz"});
  require_axes_of_plane(arguments.host(), arguments, "plane", "xy", name);
  flow = name[0] - 'x';
  gradient = name[1] - 'x';
  vorticity = 3 - flow - gradient;
}

}

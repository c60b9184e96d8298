// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_STYLE_NAMES_H
#define GRAINSCOPE_STYLE_NAMES_H

#include <string>
#include <vector>

namespace grainscope {

/** The names of all styles that one command knows, the host's and ours. */
struct StyleNames {
  const char *command;  // or `<command>_style`
  int place;            // of the style among its words
  std::vector<std::string> names;
};

const std::vector<StyleNames> &style_names();

/** The host's dump styles that this build leaves out, since they need VTK; none with GRAINSCOPE_VTK. */
const std::vector<std::string> &vtk_dump_names();

}

#endif

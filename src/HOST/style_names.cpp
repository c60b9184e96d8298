// SPDX-License-Identifier: GPL-2.0-or-later
#include "style_names.h"

// Style headers show their names alone where one of these is defined.
#define ATOM_CLASS
#define COMPUTE_CLASS
#define DUMP_CLASS
#define FIX_CLASS
#define PAIR_CLASS
#define REGION_CLASS
#define AtomStyle(name, Class) #name,
#define ComputeStyle(name, Class) #name,
#define DumpStyle(name, Class) #name,
#define FixStyle(name, Class) #name,
#define PairStyle(name, Class) #name,
#define RegionStyle(name, Class) #name,

namespace grainscope {

const std::vector<StyleNames> &style_names() {
  static const std::vector<StyleNames> all = {{"atom",
                                               0,
                                               {
#include "style_atom.h"
                                               }},
                                              {"compute",
                                               2,
                                               {
#include "style_compute.h"
                                               }},
                                              {"dump",
                                               2,
                                               {
#include "style_dump.h"
                                               }},
                                              {"fix",
                                               2,
                                               {
#include "style_fix.h"
                                               }},
                                              {"pair",
                                               0,
                                               {
#include "style_pair.h"
                                               }},
                                              {"region",
                                               1,
                                               {
#include "style_region.h"
                                               }}};
  return all;
}

const std::vector<std::string> &vtk_dump_names() {
  static const std::vector<std::string> all = {
#include "vtk_dump_names.h"
  };
  return all;
}

}

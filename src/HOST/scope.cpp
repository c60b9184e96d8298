// SPDX-License-Identifier: GPL-2.0-or-later
#include "scope.h"
#include "arguments.h"
#include "box_state.h"
#include "two_dimensions.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "modify.h"

namespace grainscope {

namespace {

struct Name {
  unsigned keyword;
  const char *name;
};

const Name names[] = {{Scope::region, "region"},     {Scope::types, "types"},   {Scope::rows, "rows"},
                      {Scope::walls, "walls"},       {Scope::volume, "volume"}, {Scope::plane, "plane"},
                      {Scope::pressure, "pressure"}, {Scope::axis, "axis"}};

const int most_types = 1000000;
const char *const volume_requirement = "auto, a positive number or v_name";
const char *const types_requirement = "two atom types, each a number or *";

}

Scope::Scope(LAMMPS_NS::LAMMPS *lmp, const std::string &style, unsigned keywords)
    : Pointers(lmp), style_(style), keywords_(keywords), volume_(lmp, style, "volume", volume_requirement) {}

std::vector<std::string> Scope::with(std::vector<std::string> own) const {
  for (const Name &one : names)
    if (keywords_ & one.keyword) own.push_back(one.name);
  return own;
}

bool Scope::read(Arguments &arguments, const std::string &keyword) {
  unsigned which = 0;
  for (const Name &one : names)
    if (keyword == one.name) which = one.keyword & keywords_;
  switch (which) {
    case region: region_.reset(new RegionSolid(lmp, style_, arguments.word("the ID of a region"))); return true;
    case types: read_types(arguments); return true;
    case rows: by_types_ = arguments.choice(keyword, {"types"}) == "types"; return true;
    case walls: {
      const std::string choice = arguments.choice(keyword, {"no", "yes", "only"});
      walls_ = choice == "no" ? Walls::no : choice == "yes" ? Walls::yes : Walls::only;
      return true;
    }
    case volume: read_volume(arguments); return true;
    case plane: plane_.read(arguments); return true;
    case pressure: {
      const std::string choice = arguments.choice(keyword, {"x", "y", "z", "mean"});
      require_axes_of_plane(lmp, arguments, keyword, "x, y or mean", choice);
      pressure_ = choice == "mean" ? mean : choice[0] - 'x';
      return true;
    }
    case axis: read_axis(arguments); return true;
    default: return false;
  }
}

void Scope::read_types(Arguments &arguments) {
  for (int *type : {&types_.a, &types_.b}) {
    const std::string word = arguments.word(types_requirement);
    double number = 0.0;
    if (word == "*") continue;
    if (!Arguments::is_number(word, number) || !(number >= 1.0 && number <= most_types) ||
        number != static_cast<int>(number))
      arguments.fail("types", types_requirement, word);
    *type = static_cast<int>(number);
  }
}

void Scope::read_volume(Arguments &arguments) {
  const std::string word = arguments.word(volume_requirement);
  volume_given_ = true;
  if (word != "auto") volume_.set(arguments, word);
}

void Scope::read_axis(Arguments &arguments) {
  const std::string choice = arguments.choice("axis", {"auto", "symmetry", "long", "short"});
  axis_is_automatic_ = choice == "auto";
  axis_ = choice == "long" ? AxisChoice::longest : choice == "short" ? AxisChoice::shortest : AxisChoice::symmetry;
}

void Scope::init() {
  for (int type : {types_.a, types_.b})
    if (type > atom->ntypes)
      Arguments(lmp, style_)
          .fail("types", "at most " + std::to_string(atom->ntypes) + ", the number of atom types",
                std::to_string(type));
  volume_.init();
  if (region_) init_region();
  else if ((keywords_ & volume) && !volume_given_) warn_of_whole_box();
}

/** What is needed of the region must be known. */
void Scope::init_region() {
  region_->init();
  if (!(keywords_ & volume)) return;
  region_->require_parts();
  if (volume_.given()) return;
  region_->update(BoxState(lmp));
  volume_of_region();
}

double Scope::volume_of_region() const {
  double value = 0.0;
  std::string why;
  if (!region_->volume(value, why))
    Arguments(lmp, style_).fail("the volume of the region is not known (" + why + "): give 'volume V'");
  return value;
}

namespace {

bool has_gravity_or_walls(const LAMMPS_NS::Modify &modify) {
  for (int k = 0; k < modify.nfix; k++) {
    const std::string style = modify.fix[k]->style;
    if (style.rfind("gravity", 0) == 0 || style.rfind("wall/", 0) == 0) return true;
  }
  return false;
}

}

void Scope::warn_of_whole_box() {
  const bool may_be_filled = domain->xperiodic && domain->yperiodic && domain->zperiodic;
  if (warned_ || (may_be_filled && !has_gravity_or_walls(*modify))) return;
  warned_ = true;
  if (comm->me == 0)
    error->warning(
        FLERR, (style_ + ": stresses and densities (not Z and numbers) are divided by the volume of the whole box, and "
                         "grains may not fill a box that is not periodic or has walls or gravity: give 'region ID' "
                         "or 'volume V' of the part that they fill, or 'volume auto' if the box is meant")
                   .c_str());
}

double Scope::volume_now(const BoxState &box) const {
  if (volume_.given()) return volume_.now();
  return region_ ? volume_of_region() : box.volume;
}

}

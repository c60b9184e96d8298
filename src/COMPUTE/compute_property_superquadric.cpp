// SPDX-License-Identifier: GPL-2.0-or-later
#include "compute_property_superquadric.h"
#include "atom.h"
#include "error.h"
#include <algorithm>
#include <cstring>
#include <iterator>
#include <string>

using namespace LAMMPS_NS;

namespace {

const char *const words[] = {"shapex", "shapey", "shapez",      "quatw",      "quati",
                             "quatj",  "quatk",  "blockiness1", "blockiness2"};

constexpr auto intensive = grainscope::Extent::intensive;

grainscope::NamedOutput output_of(const std::string &word, int ours) {
  if (ours < 0) return {word, "as in LIGGGHTS", intensive, "as in LIGGGHTS"};
  if (ours < 3) return {word, "distance", intensive, "semi-axis"};
  if (ours < 7) return {word, "-", intensive, "quaternion from the grain's axes to the laboratory's"};
  return {word, "-", intensive, "exponent of the superquadric"};
}

int word_of_ours(const Atom *atom, const char *word) {
  if (!atom->superquadric_flag) return -1;
  const auto same = [word](const char *one) { return !strcmp(one, word); };
  const auto found = std::find_if(std::begin(words), std::end(words), same);
  return found == std::end(words) ? -1 : static_cast<int>(found - std::begin(words));
}

/** The words of a command as the host takes them: another in place of each of ours, whose column is filled later. */
struct HostWords {
  std::vector<char *> all;
  HostWords(const Atom *atom, int narg, char **arg) : all(arg, arg + narg) {
    static char other[] = "id";
    for (int k = 3; k < narg; k++)
      if (word_of_ours(atom, arg[k]) >= 0) all[k] = other;
  }
};

}

ComputePropertySuperquadric::ComputePropertySuperquadric(LAMMPS *lmp, int &iarg, int narg, char **arg)
    : ComputePropertyAtom(lmp, iarg, narg, HostWords(lmp->atom, narg, arg).all.data()) {
  const int columns = std::max(1, size_peratom_cols);
  grainscope::Outputs outputs;
  for (int k = narg - columns; k < narg; k++) {
    own_.push_back(word_of_ours(atom, arg[k]));
    outputs.per_grain.add(output_of(arg[k], own_.back()));
  }
  declare(this, outputs);
}

void ComputePropertySuperquadric::init() {
  ComputePropertyAtom::init();
  for (int word : own_)
    if (word >= 0 && !atom->superquadric_flag) {
      const std::string name = words[word], style = atom->atom_style;
      const std::string problem = "compute property/atom: '" + name + "' needs atom_style superquadric, got '";
      error->all(FLERR, (problem + style + "'").c_str());
    }
}

double ComputePropertySuperquadric::value(int word, int i) const {
  if (word < 3) return atom->shape[i][word];
  if (word < 7) return atom->quaternion[i][word - 3];
  return atom->blockiness[i][word - 7];
}

void ComputePropertySuperquadric::compute_peratom() {
  ComputePropertyAtom::compute_peratom();
  for (std::size_t column = 0; column < own_.size(); column++) {
    if (own_[column] < 0) continue;
    for (int i = 0; i < atom->nlocal; i++) {
      const double found = atom->mask[i] & groupbit ? value(own_[column], i) : 0.0;
      if (size_peratom_cols == 0) vector_atom[i] = found;
      else array_atom[i][column] = found;
    }
  }
}

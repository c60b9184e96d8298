// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CHOSEN_WALLS_H
#define GRAINSCOPE_CHOSEN_WALLS_H

#include "fix_wall_gran_insitu.h"
#include <array>
#include <string>
#include <vector>

namespace grainscope {

class Arguments;
struct BoxState;

/** The walls of a compute, by name: those that it names, or all that exist when it is defined. */
class ChosenWalls {
 public:
  enum class Kind { any, mesh };

  /** Without `named` all walls. Errors say which walls there are. */
  ChosenWalls(LAMMPS_NS::LAMMPS *lmp, const Arguments &errors, Kind kind, const std::vector<std::string> &named);
  const std::vector<std::string> &names() const { return names_; }
  int size() const { return static_cast<int>(names_.size()); }
  /** Which of these it is; an error about `keyword` when there is none of that name. */
  int index_of(const std::string &name, const std::string &keyword, const Arguments &errors) const;

  /** In init(): finds them again. An error when one no longer exists, or when one is new and all were chosen. For each
   *  wall, by PartnerWall::wall, its number among these; -1: not chosen. */
  std::vector<int> find(const Arguments &errors);
  /** As they were found. */
  const std::vector<Wall> &walls() const { return walls_; }

 private:
  LAMMPS_NS::LAMMPS *lmp_;
  Kind kind_;
  bool all_;
  std::vector<std::string> names_;
  std::vector<Wall> walls_;

  std::vector<std::string> names_that_there_are() const;
  std::string there_are() const;
  void require_known(const std::string &name, const std::string &keyword, const Arguments &errors) const;
};

/** The area of a primitive wall within the box: a plane parallel to a face of the box, or a cylinder inside the box
 *  along one of its edges, where the box is not shrink-wrapped. 0 if it is not known, with the reason in `why`.
 *  `fixed`: both faces across an edge stay in place, or move as commanded. In two dimensions: the length of the line
 *  that the wall is. */
double primitive_area(const std::vector<std::string> &wall, const BoxState &box, const std::array<bool, 3> &fixed,
                      std::string &why);
/** Of this rank's triangles of a mesh, as it is now. */
double mesh_area(const Wall &wall);

}

#endif

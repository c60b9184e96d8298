// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_KEPT_WALL_HISTORY_H
#define GRAINSCOPE_KEPT_WALL_HISTORY_H

#include "fix_contact_history_mesh.h"
#include "fix_mesh_surface.h"
#include "fix_property_atom.h"
#include "fix_wall_gran.h"
#include <algorithm>
#include <vector>

namespace grainscope {

/** As KeptHistory, for the contacts of a wall with the first `grains` grains. Contacts with triangles may change their
 *  order meanwhile. */
class KeptWallHistory {
 public:
  /** `primitive` holds the history of a primitive wall, or is null. */
  KeptWallHistory(LAMMPS_NS::FixWallGran &wall, LAMMPS_NS::FixPropertyAtom *primitive, int grains)
      : primitive_(primitive), grains_(grains), width_(wall.dnum()) {
    for (int i = 0; primitive_ && i < grains_; i++)
      values_.insert(values_.end(), primitive_->array_atom[i], primitive_->array_atom[i] + width_);
    for (int k = 0; width_ > 0 && k < wall.n_meshes(); k++) keep(wall.mesh_list()[k]->contactHistory());
  }
  KeptWallHistory(const KeptWallHistory &) = delete;
  KeptWallHistory &operator=(const KeptWallHistory &) = delete;

  ~KeptWallHistory() {
    auto value = values_.begin();
    for (int i = 0; primitive_ && i < grains_; i++, value += width_)
      std::copy(value, value + width_, primitive_->array_atom[i]);
    for (const Touch &touch : touches_) {
      for (int j = 0; j < touch.history->n_partner(touch.grain); j++)
        if (touch.history->partner(touch.grain, j) == touch.triangle)
          std::copy(value, value + width_, touch.history->contacthistory(touch.grain, j));
      value += width_;
    }
  }

 private:
  struct Touch {
    LAMMPS_NS::FixContactHistoryMesh *history;
    int grain, triangle;
  };
  LAMMPS_NS::FixPropertyAtom *primitive_;
  int grains_, width_;
  std::vector<Touch> touches_;
  std::vector<double> values_;

  void keep(LAMMPS_NS::FixContactHistoryMesh *history) {
    for (int i = 0; history && i < grains_; i++)
      for (int j = 0; j < history->n_partner(i); j++) {
        touches_.push_back({history, i, history->partner(i, j)});
        const double *at = history->contacthistory(i, j);
        values_.insert(values_.end(), at, at + width_);
      }
  }
};

}

#endif

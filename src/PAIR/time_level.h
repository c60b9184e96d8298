// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_TIME_LEVEL_H
#define GRAINSCOPE_TIME_LEVEL_H

#include "contact_interface.h"
#include "half_step.h"
#include "pointers.h"
#include <algorithm>
#include <string>

namespace grainscope {

struct ContactLaw;

/** `time_level synchronized` around the contact models of LIGGGHTS, one contact after the other: the models get a grain
 *  without spin whose velocity is the relative velocity of the surfaces (half_step.h), and a spring that is already
 *  rotated. First evaluations of a run are those of LIGGGHTS: their velocities are those of x_n. */
class TimeLevel : private LAMMPS_NS::Pointers {
 public:
  using Surfaces = LIGGGHTS::ContactModels::SurfacesIntersectData;

  static constexpr int kept_columns = half_step::kept_numbers;

  explicit TimeLevel(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  /** Of the contact history: the first of the spring and of what is kept, or -1. Nothing is kept of two spheres. */
  struct Columns {
    int spring = -1, kept = -1;
  };
  /** When the models are made. `points`: the surface model has contact points of its own. */
  void set(bool synchronized, Columns columns, bool points);
  bool synchronized() const { return synchronized_; }
  int kept() const { return columns_.kept; }
  /** Those that are kept. */
  static void add_columns(LIGGGHTS::IContactHistorySetup &setup);
  /** Why contacts of these models cannot be synchronized, or "". */
  static std::string why_not(const ContactLaw &law);

  /** The evaluation repeats the last evaluation of the run before, if that was one of a step; a first evaluation was
   *  that of LIGGGHTS, and is repeated as such. */
  void set_repeats(bool repeats) { repeats_ = repeats; }

  void enter(Surfaces &s);
  void leave(Surfaces &s) const;
  /** A contact has opened. */
  void forget(double *history) const {
    if (columns_.kept >= 0 && history) std::fill_n(history + columns_.kept, kept_columns, 0.0);
  }

 private:
  bool synchronized_ = false, repeats_ = false, points_ = false;
  Columns columns_;
  bool lent_ = false;
  double velocity_[3] = {}, zero_[3] = {};
  double *lent_to_[4] = {};

  bool was_seen(const Surfaces &s) const;
  void find_velocity(const Surfaces &s, bool moves);
};

}

#endif

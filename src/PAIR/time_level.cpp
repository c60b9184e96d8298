// SPDX-License-Identifier: GPL-2.0-or-later
#include "time_level.h"
#include "contact_law.h"
#include "atom.h"
#include "update.h"

namespace grainscope {

using half_step::Moment;
using half_step::Motion;

std::string TimeLevel::why_not(const ContactLaw &law) {
  if (!law.elastic) return std::string("works with the normal models ") + ContactLaw::elastic_models() + " only";
  if (law.tangential != TangentialLaw::viscous && law.tangential != TangentialLaw::spring)
    return "works with 'tangential' history and no_history only";
  if (law.cohesive) return "works with 'cohesion' off only";
  if (law.rolls) return "works with 'rolling_friction' off only";
  if (!law.known_surface) return "works with 'surface' default, superquadric and ellipsoid only";
  return "";
}

void TimeLevel::add_columns(LIGGGHTS::IContactHistorySetup &setup) {
  const char *const turns = "1", *const stays = "0";  // as grains i and j are exchanged
  for (const char *name : {"level_normal_x", "level_normal_y", "level_normal_z"}) setup.add_history_value(name, turns);
  for (const char *name : {"level_point_x", "level_point_y", "level_point_z"}) setup.add_history_value(name, stays);
  for (const char *name : {"level_velocity_x", "level_velocity_y", "level_velocity_z"})
    setup.add_history_value(name, turns);
}

void TimeLevel::set(bool synchronized, Columns columns, bool points) {
  synchronized_ = synchronized;
  columns_ = columns;
  points_ = points;
}

void TimeLevel::enter(Surfaces &s) {
  const bool moves = s.computeflag && s.shearupdate;
  lent_ = moves || (repeats_ && was_seen(s));
  if (!lent_) return;
  find_velocity(s, moves);
  double *const was[] = {s.v_i, s.v_j, s.omega_i, s.omega_j};
  std::copy(was, was + 4, lent_to_);
  s.v_i = velocity_;
  s.v_j = s.omega_i = s.omega_j = zero_;
}

/** In a repeated evaluation; a contact that was not evaluated before (a new wall) is handled by LIGGGHTS, as in a first
 *  one. */
bool TimeLevel::was_seen(const Surfaces &s) const {
  if (columns_.kept < 0) return true;
  const double *const normal = s.contact_history + columns_.kept + half_step::kept_normal;
  return half_step::inner(normal, normal) > 0.0;
}

void TimeLevel::leave(Surfaces &s) const {
  if (!lent_) return;
  s.v_i = lent_to_[0];
  s.v_j = lent_to_[1];
  s.omega_i = lent_to_[2];
  s.omega_j = lent_to_[3];
}

/** And turns the spring, where springs move. */
void TimeLevel::find_velocity(const Surfaces &s, bool moves) {
  double *const kept = columns_.kept < 0 ? nullptr : s.contact_history + columns_.kept;
  if (kept && !moves) {
    std::copy(kept + half_step::kept_velocity, kept + half_step::kept_numbers, velocity_);
    return;
  }
  const double dt = update->dt, *const *x = atom->x;
  Motion<double> motion;
  double half[3];
  for (int k = 0; k < 3; k++) {
    motion.velocity[k] = s.v_i[k] - s.v_j[k];
    motion.spin_i[k] = s.omega_i[k];
    motion.spin_j[k] = s.is_wall ? 0.0 : s.omega_j[k];
  }
  if (kept) {
    Moment<double> now;
    const double lever = s.radi - 0.5 * s.deltan;
    for (int k = 0; k < 3; k++) {
      now.normal[k] = s.en[k];
      now.arm_i[k] = points_ ? s.contact_point[k] - x[s.i][k] : -lever * s.en[k];
      now.arm_j[k] = s.is_wall ? 0.0 : s.contact_point[k] - x[s.j][k];
    }
    half_step::of_kept(now, s.is_wall, motion, dt, kept, half, velocity_);
  } else {
    half_step::of_spheres(s.en, s.delta, s.radi, s.radj, motion, dt, half, velocity_);
  }
  if (moves && columns_.spring >= 0) half_step::turn_spring(half, s.contact_history + columns_.spring);
}

}

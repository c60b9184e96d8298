// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_OBSERVER_H
#define GRAINSCOPE_CONTACT_OBSERVER_H

#include "box_state.h"
#include "contact.h"
#include "contact_sink.h"
#include "pointers.h"
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace grainscope {

/** Passes contacts from the readers (ContactReader), which get them from the models of LIGGGHTS, to the sinks: asks the
 *  sinks before each force evaluation, and gives them its contacts, a batch at a time. If it is inactive (no sink wants
 *  the step, or LIGGGHTS evaluates forces for its own output) it costs one branch per contact. */
class ContactObserver : public ContactSink::Source, private LAMMPS_NS::Pointers {
 public:
  explicit ContactObserver(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}
  ~ContactObserver() override;

  void add(ContactSink *sink);
  void remove(ContactSink *sink) override;
  void remove_all();

  /** Registers a fix for walls, until remove_all(), or while the fix holds the returned object. */
  std::shared_ptr<void> add_wall() {
    set_up_++;
    return walls_;
  }
  /** An error if a fix for walls was removed: a run without set-up would use its contacts. Collective. */
  void require_walls() const;

  /** Contacts must be read in every evaluation, because they keep their past (`ledger on`). */
  void set_keeps_past(bool keeps) { keeps_past_ = keeps; }
  bool keeps_past() const { return keeps_past_; }
  /** A run begins: the past that contacts keep is that of the previous evaluation only if that was in this run. */
  void begin_run() { runs_++; }
  /** A run has ended: the sinks compute the results that may be requested afterwards. */
  void end_run() const;

  /** Asks the sinks, before a force evaluation. `springs_move`: false in the first of a run. `repeats`: it repeats the
   *  last evaluation of the previous run. Returns true if one of the sinks needs image shifts. */
  bool begin(bool springs_move, bool repeats);
  /** A fix for walls begins: all of them come after the grains of the same evaluation. */
  void begin_wall();
  /** The contacts between grains, or those of one fix for walls, are complete. */
  void end();
  bool active() const { return active_; }
  /** An error, in the name of `who`, if walls have not yet evaluated their contacts: at the start of a run fixes may
   *  use a compute before a wall that is defined after them. */
  void require_complete(const std::string &who) const;
  bool repeats() const { return repeats_; }
  /** Identifies the evaluation: contacts remember it. Negative where no spring moved. */
  double stamp() const { return stamp_; }
  double stamp_before() const { return stamp_before_; }
  void resume(double stamp) { stamp_ = stamp; }
  /** No spring moved in the evaluation, nor in the one that it repeats. */
  bool first_evaluation() const { return stamp_ < 0.0; }
  /** Whether tangential springs were moved in the last evaluation. */
  bool springs_move() const { return springs_move_; }
  /** Whether a sink needs Contact::motion. */
  bool needs_motion() const { return motion_; }
  /** The box as it was in the evaluation that was observed last. */
  const BoxState &box() const { return box_; }
  /** The time step of the evaluation: at the end of a step it may have been changed already. */
  double time_step() const { return dt_; }
  const double *const *positions() const { return x_; }
  int local_grains() const { return n_local_; }

  /** A contact to be filled in, which may hold another contact of this evaluation; sinks get it at the latest when the
   *  evaluation ends. `in_lanes`: those that take lanes get it by take(). */
  Contact &next(bool in_lanes = false) {
    if (next_ == batch_.data() + batch_.size() || in_lanes != in_lanes_) hand_over();
    in_lanes_ = in_lanes;
    return *next_++;
  }
  /** Contacts side by side, to the sinks that take them so. */
  void take(const ContactLanes &contacts) const {
    for (ContactSink *sink : takers_) sink->add_lanes(contacts);
  }
  bool takes_lanes() const { return !takers_.empty(); }
  /** Whether the motion of GroupForces is read. */
  bool lanes_need_motion() const { return lanes_motion_; }
  /** Whether all contacts must come one by one, too. */
  bool needs_records() const { return takers_.size() < listening_.size(); }

  /** Image shift of atom j, three integers as doubles: x_j = x_owner + H . shift. Valid when a sink asked for
   *  images. */
  const double *image_shift(int j) const { return &image_shifts_[3 * j]; }
  std::vector<double> &image_shifts() { return image_shifts_; }
  /** Velocity of ghost j less its owner's, dH/dt . shift, where the box deforms with `remap v`. */
  Eigen::Vector3d image_velocity(int j) const {
    return box_.edge_velocities * Eigen::Map<const Eigen::Vector3d>(image_shift(j));
  }

 private:
  std::vector<ContactSink *> sinks_, listening_;
  std::vector<ContactSink *> takers_, others_;  // of those that listen: who takes lanes, and who does not
  std::array<Contact, 32> batch_;               // 16 kB: they stay in the first cache
  Contact *next_ = batch_.data();               // the first that is not filled in
  bool in_lanes_ = false;                       // the batch is of contacts that went to takers_ already
  bool active_ = false;
  std::shared_ptr<void> walls_ = std::make_shared<int>();  // each fix for walls holds it, too
  int set_up_ = 0;                                         // fixes for walls when the run was set up
  int to_come_ = 0;                                        // those of this evaluation that are not through
  bool wanted_ = false;                                    // the evaluation, by a sink or for what contacts remember
  bool motion_ = false;
  bool lanes_motion_ = false;
  bool keeps_past_ = false;
  bool springs_move_ = true;
  bool repeats_ = false;
  long runs_ = 0;
  // of this evaluation and the one before: step, and a fraction that differs from run to run
  double stamp_ = -1.0, stamp_before_ = -1.0;
  BoxState box_;
  double **x_ = nullptr;  // of the evaluation under way, as the two below
  int n_local_ = 0;
  double dt_ = 0.0;
  std::vector<double> image_shifts_;

  void hand_over();
  int walls_there() const;
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_OBSERVER_H
#define GRAINSCOPE_CONTACT_OBSERVER_H

#include "box_state.h"
#include "contact.h"
#include "contact_sink.h"
#include "contact_interface.h"
#include "pair_gran.h"
#include "pointers.h"
#include <vector>

namespace grainscope {

/** Between the host's contact model and the sinks: turns the model's working data into one Contact and deals it out.
 *  Inactive (no sink wants the step, or the host re-evaluates for its own output) it costs one branch per contact. */
class ContactObserver : public ContactSink::Source, private LAMMPS_NS::Pointers {
 public:
  enum class TangentialLaw { off, no_history, history, other };

  explicit ContactObserver(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}
  ~ContactObserver();

  void add(ContactSink *sink);
  void remove(ContactSink *sink) override;
  void remove_all();

  void set_law(TangentialLaw law, int spring_offset) { law_ = law; spring_offset_ = spring_offset; }
  /** Whether the normal model is an elastic spring and a dashpot: then its stiffness and damping are what the model says. */
  void set_elastic(bool elastic) { elastic_ = elastic; }
  /** Whether a normal force that would be negative is set to 0. */
  void set_limits_force(bool limits) { limits_force_ = limits; }
  /** Whether cohesion has a tangential force of its own, which no friction limits. */
  void set_wet(bool wet) { wet_ = wet; }
  bool elastic() const { return elastic_; }
  void set_friction(double **coefficients) { friction_ = coefficients; }
  TangentialLaw law() const { return law_; }
  /** First of the columns of the contact history that hold a ContactPast, or -1. */
  void set_past(int offset) { past_offset_ = offset; }
  bool knows_past() const { return past_offset_ >= 0; }
  static constexpr int past_columns = 6;
  static const char *past_column(int k);
  void set_rolling(bool rolls) { rolls_ = rolls; }
  bool rolls() const { return rolls_; }
  /** A run begins: what contacts remember is of the evaluation before only when it was of this run. */
  void begin_run() { runs_++; }

  /** Asks the sinks, before a force evaluation. `springs_move`: false in the first of a run. `again`: it repeats the last evaluation of the run
   *  before. Returns true if one of the sinks needs image shifts. */
  bool begin(bool springs_move, bool again);
  bool again() const { return again_; }
  /** What tells the evaluation from others: contacts remember it. Negative where no spring moved. */
  double stamp() const { return stamp_; }
  /** No spring moved in the evaluation, nor in the one that it repeats. */
  bool first_evaluation() const { return stamp_ < 0.0; }
  void resume(double stamp) { stamp_ = stamp; }
  /** Whether tangential springs were moved in the last evaluation. */
  bool springs_move() const { return springs_move_; }
  void end() { active_ = false; }
  /** Of a run: for the sinks. */
  void end_run() const;
  bool active() const { return active_; }
  /** The box as it was in the evaluation that was observed last. */
  const BoxState &box() const { return box_; }
  /** The time step of the evaluation: at the end of a step it may have been changed already. */
  double time_step() const { return dt_; }

  /** Image shift of atom j, three integers as doubles: x_j = x_owner + H . shift. Valid when a sink asked for images. */
  const double *image_shift(int j) const { return &image_shifts_[3 * j]; }
  std::vector<double> &image_shifts() { return image_shifts_; }
  /** Velocity of ghost j less its owner's, dH/dt . shift, where the box deforms with `remap v`. */
  Eigen::Vector3d image_velocity(int j) const {
    return box_.edge_velocities * Eigen::Map<const Eigen::Vector3d>(image_shift(j));
  }

  using Sides = LIGGGHTS::ContactModels::SurfacesIntersectData;
  using Forces = LIGGGHTS::ContactModels::ForceData;
  void remember_spring(const Sides &s) {
    if (law_ != TangentialLaw::history) return;
    double *spring = s.contact_history + spring_offset_;
    for (int k = 0; k < 3; k++) {
      // Springs that were cut to the limit are at it, but for rounding: in a repetition a touch more keeps them sliding. It is not kept.
      if (again_) spring[k] *= 1.0 + 1e-12;
      spring_[k] = spring[k];
    }
  }
  void observe(const Sides &s, const Forces &force_on_i);

 private:
  std::vector<ContactSink *> sinks_, listening_;
  bool active_ = false;
  bool details_ = false;
  TangentialLaw law_ = TangentialLaw::other;
  int spring_offset_ = 0;
  bool elastic_ = false;
  bool limits_force_ = false;
  bool wet_ = false;
  bool rolls_ = false;
  bool springs_move_ = true;
  bool again_ = false;
  int past_offset_ = -1;
  long runs_ = 0;
  double stamp_ = -1.0, stamp_before_ = -1.0;   // of this evaluation and the one before: step, and a fraction that tells runs apart
  double spring_[3] = {0.0, 0.0, 0.0};
  double **friction_ = nullptr;
  BoxState box_;
  double **x_ = nullptr;           // of the evaluation under way, as the two below
  int n_local_ = 0;
  double dt_ = 0.0;
  std::vector<double> image_shifts_;

  /** What friction made of one contact. */
  struct Friction {
    double limit;                       // of the force
    bool cut = false;                   // the spring was, or the force of a law without springs
    bool beyond = false;                // not cut, but kept to the limit by damping, or beyond it: in first evaluations
    double slip = 0.0;
    double damping = 0.0;               // the coefficient that acts where it is not cut
    double spring[3] = {0.0, 0.0, 0.0}; // before the cut
  };
  Friction judge_friction(const Sides &s, double limit) const;
  void judge_spring(const Sides &s, Friction &friction) const;
  void judge_damping(const Sides &s, Friction &friction) const;
  Eigen::Vector3d friction_force(const Sides &s, const Friction &friction, const Contact &c) const;
  double normal_damping(const Sides &s) const;
  void add_details(const Sides &s, const Friction &friction, Contact &c) const;
  void add_springs(const Sides &s, const Friction &friction, const Forces &force_on_i, Contact &c) const;
  ContactPast read_past(const Sides &s) const;
  void write_past(const Sides &s, const Contact &c) const;
};

}

#endif

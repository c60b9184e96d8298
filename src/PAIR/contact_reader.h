// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_READER_H
#define GRAINSCOPE_CONTACT_READER_H

#include "contact_law.h"
#include "contact_observer.h"
#include "past_lanes.h"
#include "contact_interface.h"

namespace grainscope {

/** The contact model around which a reader stands; see Observed. */
class ObservedModel {
 protected:
  ObservedModel() = default;
  ~ObservedModel() = default;
};

/** Makes Contacts of the working data of one contact model of LIGGGHTS, of the pair style or of a wall, and gives them
 *  to the observer. Called before and after the model. */
class ContactReader {
 public:
  using Surfaces = LIGGGHTS::ContactModels::SurfacesIntersectData;
  using Forces = LIGGGHTS::ContactModels::ForceData;

  explicit ContactReader(ContactObserver &observer) : observer_(observer) {}
  const ContactObserver &observer() const { return observer_; }

  void set_law(const ContactLaw &law) { law_ = law; }
  const ContactLaw &law() const { return law_; }

  void set_model(ObservedModel *model) { model_ = model; }
  /** The one that was made last. */
  ObservedModel *model() const { return model_; }

  static constexpr int past_columns = PastColumns::count;
  static const char *past_column(int k);

  void before(const Surfaces &s) {
    if (law_.tangential != TangentialLaw::spring) return;
    double *spring = s.contact_history + law_.spring_column;
    for (int k = 0; k < 3; k++) {
      // Springs that were cut to the limit are at it within rounding: in a repetition a small excess keeps them
      // sliding. It is not kept.
      if (observer_.repeats()) spring[k] *= 1.0 + 1e-12;
      spring_[k] = spring[k];
    }
  }
  /** Two grains touch. */
  void after(const Surfaces &s, const Forces &force_on_i);
  /** Two grains touch, of a group whose law was worked out side by side: the pair in lane k, its atom types. */
  void after(const PairGroup &group, const GroupGeometry &geometry, const GroupForces &forces, int k,
             const int types[2]);
  /** A grain touches a wall; its velocity is read here. */
  void after_wall(const Surfaces &s, const Forces &force_on_i, const PartnerWall &wall);

 private:
  ContactObserver &observer_;
  ContactLaw law_;
  ObservedModel *model_ = nullptr;
  double spring_[3] = {0.0, 0.0, 0.0};  // before the model moved it
  Surfaces seen_{};                     // of a contact in a lane, what is read of it

  /** What friction made of one contact. */
  struct Friction {
    double coefficient;   // mu_p
    double limit;         // of the force
    bool cut = false;     // the spring was, or the force of a law without springs
    bool beyond = false;  // not cut, but kept to the limit by damping, or beyond it: in first evaluations
    double slip = 0.0;
    double damping = 0.0;                // the coefficient that acts where it is not cut
    double spring[3] = {0.0, 0.0, 0.0};  // before the cut
  };
  Friction friction_of(const Surfaces &s) const;
  void repeat_spring(const Surfaces &s, Friction &friction) const;
  void compare_damping(const Surfaces &s, Friction &friction) const;
  void read(const Surfaces &s, const Forces &force_on_i, const Friction &friction, Contact &c) const;
  Eigen::Vector3d friction_force(const Surfaces &s, const Friction &friction, const Contact &c) const;
  double normal_damping(const Surfaces &s) const;
  Eigen::Vector3d contact_point(const Surfaces &s) const;
  void read_motion(const Surfaces &s, const Friction &friction, Contact &c) const;
  void read_spring(const Surfaces &s, const Friction &friction, Contact &c) const;
  void read_rolling(const Surfaces &s, const Forces &force_on_i, Contact &c) const;
  ContactVelocity velocity_at_force(const Surfaces &s, const Contact &c) const;
  void read_past(const Surfaces &s, Contact &c) const;
  void write_past(const Surfaces &s, const Contact &c) const;
  void renew_past(const Surfaces &s, const Friction &friction, Contact &c) const;
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_observer.h"
#include "atom.h"
#include "update.h"
#include <algorithm>
#include <cmath>

namespace grainscope {

using Eigen::Map;
using Eigen::Vector3d;

ContactObserver::~ContactObserver() { remove_all(); }

void ContactObserver::add(ContactSink *sink) {
  if (std::find(sinks_.begin(), sinks_.end(), sink) != sinks_.end()) return;
  sinks_.push_back(sink);
  sink->set_source(this);
}

void ContactObserver::remove(ContactSink *sink) {
  sinks_.erase(std::remove(sinks_.begin(), sinks_.end(), sink), sinks_.end());
  listening_.erase(std::remove(listening_.begin(), listening_.end(), sink), listening_.end());
}

void ContactObserver::remove_all() {
  for (ContactSink *sink : sinks_) sink->set_source(nullptr);
  sinks_.clear();
  listening_.clear();
}

bool ContactObserver::begin() {
  listening_.clear();
  bool images = false;
  for (ContactSink *sink : sinks_)
    if (sink->wants_contacts()) listening_.push_back(sink);
  active_ = !listening_.empty();
  if (active_) box_ = BoxState(lmp);
  for (ContactSink *sink : listening_) {
    sink->begin_contacts();
    images = images || sink->needs_images();
  }
  return images;
}

/** The spring as it was before the friction limit, in the host's own operations and order, so that a spring that was not cut
 *  compares equal to the last bit. In the first evaluation of a run the host moves no spring: sliding then means that the force was
 *  limited, and slip is what would have been cut. */
void ContactObserver::judge_sliding(const Sides &s, Contact &c) const {
  c.sliding = false;
  c.slip = 0.0;
  c.friction = friction_ ? friction_[s.itype][s.jtype] : 0.0;
  const double limit = c.friction * std::fabs(s.Fn);
  if (law_ == TangentialLaw::no_history) {
    const double speed = std::sqrt(s.vtr1 * s.vtr1 + s.vtr2 * s.vtr2 + s.vtr3 * s.vtr3);
    c.sliding = limit < s.gammat * speed;
    if (c.sliding) c.slip = speed * lmp->update->dt;
  } else if (law_ == TangentialLaw::history) {
    double trial[3] = {spring_[0], spring_[1], spring_[2]};
    if (s.computeflag && s.shearupdate) {
      const double dt = lmp->update->dt;
      trial[0] += s.vtr1 * dt;
      trial[1] += s.vtr2 * dt;
      trial[2] += s.vtr3 * dt;
      const double along = trial[0] * s.en[0] + trial[1] * s.en[1] + trial[2] * s.en[2];
      trial[0] -= along * s.en[0];
      trial[1] -= along * s.en[1];
      trial[2] -= along * s.en[2];
    }
    const double length = std::sqrt(trial[0] * trial[0] + trial[1] * trial[1] + trial[2] * trial[2]);
    c.sliding = s.kt * length > limit;
    if (c.sliding) c.slip = length - limit / s.kt;
  }
}

void ContactObserver::observe(const Sides &s, const LIGGGHTS::ContactModels::ForceData &force_on_i) {
  Contact c;
  c.i = s.i;
  c.j = s.j;
  c.ghost = s.j >= lmp->atom->nlocal;
  c.weight = c.ghost ? 0.5 : 1.0;
  const Map<const Vector3d> xi(lmp->atom->x[s.i]), xj(lmp->atom->x[s.j]);
  c.branch = xi - xj;
  c.normal = Map<const Vector3d>(s.en);
  if (s.is_non_spherical) c.point = Map<const Vector3d>(s.contact_point);
  else c.point = xi - s.cri * c.normal;
  c.overlap = s.deltan;
  c.force = Map<const Vector3d>(force_on_i.delta_F);
  c.normal_force = c.force.dot(c.normal);
  c.normal_stiffness = s.kn;
  c.tangential_stiffness = s.kt;
  c.damping_coefficient = s.gamman;
  c.tangential_damping = law_ == TangentialLaw::off ? 0.0 : s.gammat;
  c.normal_velocity = s.vn;
  // `limitForce` sets a negative total to exactly 0: the damping part is then what cancels the elastic one.
  c.normal_damping = elastic_ && s.Fn == 0.0 ? -s.kn * s.deltan : -s.gamman * s.vn;
  c.tangential_force = c.force - c.normal_force * c.normal;
  c.tangential_velocity = Vector3d(s.vtr1, s.vtr2, s.vtr3);
  judge_sliding(s, c);
  for (ContactSink *sink : listening_) sink->add_contact(c);
}

}

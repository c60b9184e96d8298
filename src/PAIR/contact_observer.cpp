// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_observer.h"
#include "atom.h"
#include "error.h"
#include "update.h"
#include <algorithm>

namespace grainscope {

ContactObserver::~ContactObserver() { remove_all(); }

void ContactObserver::add(ContactSink *sink) {
  if (std::find(sinks_.begin(), sinks_.end(), sink) != sinks_.end()) return;
  sinks_.push_back(sink);
  sink->set_source(this);
}

void ContactObserver::remove(ContactSink *sink) {
  sinks_.erase(std::remove(sinks_.begin(), sinks_.end(), sink), sinks_.end());
  for (std::vector<ContactSink *> *some : {&listening_, &takers_, &others_})
    some->erase(std::remove(some->begin(), some->end(), sink), some->end());
}

void ContactObserver::remove_all() {
  for (ContactSink *sink : sinks_) sink->set_source(nullptr);
  sinks_.clear();
  listening_.clear();
  takers_.clear();
  others_.clear();
  walls_ = std::make_shared<int>();
  set_up_ = 0;
}

bool ContactObserver::begin(bool springs_move, bool repeats) {
  springs_move_ = springs_move;
  repeats_ = repeats;
  listening_.clear();
  next_ = batch_.data();
  bool images = false;
  for (ContactSink *sink : sinks_)
    if (sink->wants_contacts()) listening_.push_back(sink);
  active_ = wanted_ = !listening_.empty() || keeps_past_;
  to_come_ = walls_there();
  stamp_before_ = repeats ? -1.0 : stamp_;
  if (!repeats) {
    stamp_ = lmp->update->ntimestep + (runs_ % 1023 + 1) / 1024.0;  // never 0, which is what a new neighbour has
    if (!springs_move) stamp_ = -stamp_;
  }
  if (active_) {
    require_walls();
    box_ = BoxState(lmp);
    x_ = lmp->atom->x;
    n_local_ = lmp->atom->nlocal;
    dt_ = lmp->update->dt;
    batch_.fill(Contact());
  }
  motion_ = lanes_motion_ = keeps_past_;
  takers_.clear();
  others_.clear();
  for (ContactSink *sink : listening_) {
    sink->begin_contacts();
    const bool takes_lanes = sink->takes_lanes();
    (takes_lanes ? takers_ : others_).push_back(sink);
    lanes_motion_ = lanes_motion_ || (takes_lanes && sink->lanes_need_motion());
    motion_ = motion_ || sink->needs_motion();
    images = images || sink->needs_images();
  }
  return images;
}

void ContactObserver::hand_over() {
  const ContactSpan contacts(batch_.data(), next_ - batch_.data());
  if (contacts.size())
    for (ContactSink *sink : in_lanes_ ? others_ : listening_) sink->add_contacts(contacts);
  next_ = batch_.data();
}

void ContactObserver::begin_wall() {
  to_come_--;
  active_ = wanted_;
  if (active_) batch_.fill(Contact());  // a wall's law may leave out what the grains' fills in
}

void ContactObserver::end() {
  if (next_ != batch_.data()) hand_over();
  active_ = false;
  if (to_come_ > 0) return;
  for (ContactSink *sink : listening_) sink->end_contacts();
}

void ContactObserver::require_complete(const std::string &who) const {
  if (to_come_ <= 0) return;
  error->all(FLERR, (who + ": evaluated at the start of a run before all fixes wall/gran have computed their contacts. "
                           "Define the fix that uses it, such as fix ave/time, after them")
                        .c_str());
}

int ContactObserver::walls_there() const { return static_cast<int>(walls_.use_count()) - 1; }

void ContactObserver::require_walls() const {
  if (walls_there() < set_up_)
    error->all(FLERR, "pair_style gran/insitu: a fix wall/gran was removed after the last set-up of a run, and "
                      "contacts are measured: do not use 'pre no'");
}

void ContactObserver::end_run() const {
  for (ContactSink *sink : sinks_) sink->end_run();
}

}

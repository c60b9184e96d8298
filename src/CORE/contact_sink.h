// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_SINK_H
#define GRAINSCOPE_CONTACT_SINK_H

namespace grainscope {

class ContactSpan;
struct ContactLanes;

/** Receives contacts. Before a force evaluation a source (pair_style gran/insitu) asks each sink whether it wants the
 *  contacts, and then hands it every contact once per owner, many at a time. Sink and source may be destroyed in either
 *  order. */
class ContactSink {
 public:
  class Source {
   public:
    virtual void remove(ContactSink *sink) = 0;

   protected:
    ~Source() {}
  };

  ContactSink() : source_(nullptr) {}
  virtual ~ContactSink() {
    if (source_) source_->remove(this);
  }
  ContactSink(const ContactSink &) = delete;
  ContactSink &operator=(const ContactSink &) = delete;

  /** True if the coming evaluation is wanted; called once, before it, on every rank alike. */
  virtual bool wants_contacts() = 0;
  /** The evaluation begins: forget the last one. */
  virtual void begin_contacts() = 0;
  virtual void add_contacts(ContactSpan contacts) = 0;
  /** True if contacts between grains of the evaluation that begins may also come side by side, to add_lanes(). */
  virtual bool takes_lanes() const { return false; }
  virtual void add_lanes(const ContactLanes &) {}
  /** False if the motion in GroupForces is not used there. */
  virtual bool lanes_need_motion() const { return true; }
  /** False if Contact::motion is not used. */
  virtual bool needs_motion() const { return true; }
  /** True if image shifts of ghosts must be known during the evaluation. */
  virtual bool needs_images() const { return false; }
  /** The evaluation is complete. */
  virtual void end_contacts() {}
  /** A run has ended: results of the last evaluation are to be computed now, while grains are as they were then. Called
   *  on every rank alike. */
  virtual void end_run() {}

  void set_source(Source *source) { source_ = source; }
  /** False once the source is gone: what was kept of it must not be used. */
  bool attached() const { return source_; }

 private:
  Source *source_;
};

}

#endif

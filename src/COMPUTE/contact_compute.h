// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_COMPUTE_H
#define GRAINSCOPE_CONTACT_COMPUTE_H

#include "compute.h"
#include "bodies.h"
#include "contact_sink.h"
#include "scope.h"
#include "type_pairs.h"
#include <string>
#include <vector>

namespace grainscope {

class Arguments;
class ContactObserver;
struct Contact;
struct ContactLaw;

/** A compute that sees contacts. It gets the contacts of the force evaluations of the steps for which LIGGGHTS
 *  announced it (through thermo, fix ave/time, dumps, or variables in them), and of the last step of every run; on any
 *  other step it gives an error. Scalar, vector, array and rows are computed when a run ends, so that the input script
 *  can use them until the next run begins.
 *
 *  A measure that is made of sums declares them (`sums_over`, see contact_sums.h) and fills its outputs from them in
 *  `answer`. A measure that keeps contacts or grains overrides begin_contacts and add_contacts. */
class ContactCompute : public LAMMPS_NS::Compute, public ContactSink {
 public:
  /** What a measure adds up. */
  class Accumulator {
   public:
    virtual ~Accumulator() {}
    virtual void reset() = 0;
    virtual void add(ContactSpan contacts, const ContactCompute &of) = 0;
    /** True if all contacts between grains may also come side by side. */
    virtual bool takes_lanes() const { return false; }
    virtual void add(const ContactLanes &) {}
    virtual bool lanes_need_motion() const { return true; }
  };

  /** `keywords`: those of Scope that the measure understands. `walls`: the default of the keyword `walls`. */
  ContactCompute(LAMMPS_NS::LAMMPS *lmp, int &iarg, int narg, char **arg, unsigned keywords, Walls walls = Walls::yes);

  void init() override;
  double compute_scalar() override;
  void compute_vector() override;
  void compute_array() override;
  bool wants_contacts() override;
  void begin_contacts() override;
  void add_contacts(ContactSpan contacts) override;
  /** True if all contacts between grains belong to the measure, and all its sums take them side by side. */
  bool takes_lanes() const override;
  void add_lanes(const ContactLanes &contacts) override;
  bool lanes_need_motion() const override;
  void end_run() override;
  bool needs_motion() const override { return reads_motion() || scope_.within(); }

  /** The contacts that belong to the measure: all of their grains are in the group, and they are in the scope. */
  struct Selection {
    const int *mask;
    int bit;
    Walls walls;
    bool narrow;  // there is more to ask for
    TypePair types;
    const RegionSolid *region;
    bool has(const Contact &c) const;
    /** By group and walls alone. */
    bool takes_grains_of(const Contact &c) const;
    /** Wherever they are. */
    Selection everywhere() const;
  };
  Selection selection() const;
  const Scope &scope() const { return scope_; }
  /** Of a measure that uses them. */
  const Bodies &bodies() const { return *bodies_; }
  /** Sums `values` over all ranks, in place. */
  void sum_over_ranks(double *values, int n) const;

 protected:
  ContactObserver *observer_;
  std::string name_;  // "compute <style>", for messages
  Scope scope_;
  std::unique_ptr<Bodies> bodies_;  // as of the evaluation

  void sums_over(Accumulator &sums) { sums_.push_back(&sums); }
  /** False if Contact::motion is not used, but for the place of contacts in a region. */
  virtual bool reads_motion() const { return true; }
  /** True where clumps count as one grain: bodies() are those of the evaluation. */
  virtual bool uses_bodies() const { return false; }
  /** Fills scalar, vector and array, as far as there are, for the evaluation that was tallied. Collective. */
  virtual void answer();

  bool in_group(int i) const;
  /** The pairs of atom types, for 'rows types'; an error where there are no types yet. In the constructor. */
  TypePairs type_pairs() const;
  /** Of contacts between grains. */
  const ContactLaw &law() const;
  /** Of all contacts that belong to the measure. */
  std::vector<const ContactLaw *> laws_of_contacts() const;
  /** Errors unless the damping and friction of the contact model, and of those of walls where they are chosen, are
   *  known, because their powers are reported. In init(). */
  void require_known_losses() const;
  /** Errors unless the current step was tallied, with all its contacts. */
  void require_tally() const;
  /** False if a result that was not requested could end the run. */
  virtual bool answers_after_run() const { return true; }
  /** No result was requested yet: no warnings. */
  bool unasked() const { return unasked_; }
  /** Errors unless `contacts`, the number over all ranks of those whose place or direction is not finite, is 0. */
  void require_finite(double contacts) const;

 private:
  std::vector<Accumulator *> sums_;
  LAMMPS_NS::bigint tallied_;
  bool unasked_;
  bool run_over_ = false;  // since the last tally

  bool kept_since_run(LAMMPS_NS::bigint answered) const;
  void answer_once(LAMMPS_NS::bigint &answered);
};

}

#endif

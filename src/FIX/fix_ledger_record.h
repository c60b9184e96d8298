// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(ledger/record,FixLedgerRecord)

#else

#ifndef LMP_FIX_LEDGER_RECORD_H
#define LMP_FIX_LEDGER_RECORD_H

#include "contact_sink.h"
#include "internal_fix.h"
#include <memory>
#include <string>

namespace grainscope {
struct LedgerAccount;
}

namespace LAMMPS_NS {

/** Keeps the energy ledger of a group up to date in every step, for a compute. It sees every contact of every force
 *  evaluation, and the grains before their second kick and before the first kick of the next step. Its totals are in
 *  restart files. Made by computes, not by input scripts. */
class FixLedgerRecord : public grainscope::InternalFix, public grainscope::ContactSink {
 public:
  FixLedgerRecord(class LAMMPS *lmp, int narg, char **arg);
  ~FixLedgerRecord() override;
  int setmask() override;
  void init() override;
  void pre_initial_integrate() override;
  void pre_exchange() override;
  void pre_final_integrate() override;
  void write_restart(FILE *file) override;
  void restart(char *buffer) override;

  bool wants_contacts() override { return true; }
  void begin_contacts() override;
  void add_contacts(grainscope::ContactSpan contacts) override;
  bool takes_lanes() const override { return true; }
  void add_lanes(const grainscope::ContactLanes &contacts) override;
  void end_contacts() override;
  void end_run() override;

  /** Makes the record of compute `id`, in its constructor; `style` is for messages. Collective. */
  static FixLedgerRecord *make(class LAMMPS *lmp, const char *id, int igroup, const std::string &style);
  /** The record that was made, or an error when it is gone. */
  static FixLedgerRecord *find(class LAMMPS *lmp, const char *id);
  /** To be called by the compute's destructor. */
  static void forget(class LAMMPS *lmp, const char *id);

  /** Everything booked so far, summed over all ranks. Collective. */
  grainscope::LedgerAccount account() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;

  [[noreturn]] void fail(const std::string &message) const;
  bool grains_may_pass() const;
};

}

#endif
#endif

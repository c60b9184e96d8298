// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef PAIR_CLASS

PairStyle(gran/insitu,PairGranInsitu)

#else

#ifndef LMP_PAIR_GRAN_INSITU_H
#define LMP_PAIR_GRAN_INSITU_H

#include "ellipsoid_owner.h"
#include "pair_gran_proxy.h"
#include <memory>
#include <string>
#include <vector>

namespace grainscope {
class ContactObserver;
class ContactReader;
class EvaluationMemory;
class LaneLaw;
class TimeLevel;
struct ContactLaw;
}

namespace LAMMPS_NS {

/** pair_style gran, with every contact of a force evaluation offered to the computes and fixes that ask for it.
 *  Same arguments, same loop, same trajectory to the last bit; see doc/pair_gran_insitu.md. */
class PairGranInsitu : public PairGranProxy, public grainscope::EllipsoidOwner {
 public:
  explicit PairGranInsitu(LAMMPS *lmp);
  ~PairGranInsitu() override;

  /** The one in use, or an error that names `who` and what is in use instead. */
  static PairGranInsitu *required_by(LAMMPS *lmp, const char *who);

  void settings(int narg, char **arg) override;
  void init_style() override;
  void init_granular() override;
  void compute(int eflag, int vflag) override;
  void compute_pgl(int eflag, int vflag) override;
  void compute_force(int eflag, int vflag, int addflag) override;
  void write_restart_settings(FILE *file) override;
  void read_restart_settings(FILE *file, const int major, const int minor) override;
  int get_history_offset(const std::string name) override;
  double stressStrainExponent() override;
  bool contact_match(const std::string kind, const std::string model) override;
  int64_t hashcode() override;
  int pack_comm(int n, int *list, double *buf, int pbc_flag, int *pbc) override;
  void unpack_comm(int n, int first, double *buf) override;

  grainscope::ContactObserver &observer();
  grainscope::ContactReader &reader();
  grainscope::LaneLaw &lane_law();
  grainscope::TimeLevel &time_level();
  /** Of the run that was set up last. */
  const grainscope::ContactLaw &law() const;
  /** `ledger on`. */
  bool keeps_past() const;
  /** With `setup neutral`, from the first set-up on; else null. */
  std::shared_ptr<grainscope::EvaluationMemory> evaluation_memory() const;
  /** The words of the command that name models and settings. */
  const std::string &models() const;
  /** Before a run: grains were given other IDs since the last, and with them each other's springs. */
  bool renumbered() const;
  grainscope::EllipsoidBodies &ellipsoid_bodies() override;
  grainscope::EllipsoidSurface &ellipsoid_surface() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;

  void synchronize();
  grainscope::ContactLaw law_of_models();
  void add_past_columns();
  int columns_in_restart() const;
  int column_of(const std::string &name) const;
  void set_tangential_bound();
  void watch_time_step();
  void update_image_shifts();
};

}

#endif
#endif

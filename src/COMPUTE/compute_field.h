// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(field,ComputeField)

#else

#ifndef LMP_COMPUTE_FIELD_H
#define LMP_COMPUTE_FIELD_H

#include "chosen_axis.h"
#include "contact_compute.h"
#include "field_map.h"
#include "field_settings.h"
#include "field_source.h"
#include "outputs.h"

namespace LAMMPS_NS {

/** Continuum fields of grains and contacts on a grid: densities, velocity, temperature, stress, fabric, order, power.
 *  Kernel cell: what lies in a cell, of branches the part inside, so that cells add up to the box; lucy, gaussian:
 *  phi(r - x) about the middles, branches in closed form. Array: a row per cell, x fastest: middle, volume, grains,
 *  then the quantities that were asked for. Scalar: cells that hold grains. Vector: totals, and grains in no cell.
 *  Source: Goldhirsch 2010, doi 10.1007/s10035-010-0181-z; walls: Weinhart et al. 2012, doi
 *  10.1007/s10035-012-0317-4. */
class ComputeField : public grainscope::ContactCompute,
                     public grainscope::DeclaresOutputs,
                     public grainscope::FieldSource {
 public:
  ComputeField(class LAMMPS *lmp, int &iarg, int narg, char **arg);
  void init() override;
  bool wants_contacts() override;
  void begin_contacts() override;
  void add_contacts(grainscope::ContactSpan contacts) override;
  bool reads_motion() const override;
  double memory_usage() override;

  const grainscope::FieldSums &sums() const override { return sums_; }
  const grainscope::FieldCells &cells() const override { return map_.cells(); }
  const grainscope::FieldQuantities &quantities() const override { return quantities_; }
  grainscope::FieldUnits units() const override;
  bool moves_with_box() const override { return settings_.moves_with_box(); }

 protected:
  void answer() override;

 private:
  grainscope::FieldSettings settings_;
  grainscope::FieldQuantities quantities_;
  grainscope::FieldMap map_;    // as of the evaluation
  grainscope::FieldSums sums_;  // of this rank, after the answer of all
  grainscope::BoxState box_;
  double outside_ = 0.0;
  bool answered_ = false;    // since the evaluation: vector and array are asked for one after the other
  double not_finite_ = 0.0;  // contacts without a place
  double flat_ = 0.0, with_axis_ = 0.0;
  grainscope::MixtureWarning mixture_;

  grainscope::FieldQuantities read(int &iarg, int narg, char **arg);
  void begin(const grainscope::BoxState &box);
  void add_contact(const grainscope::Contact &c);
  void add_branch(const grainscope::Contact &c, const Eigen::Vector3d &centre);
  struct Share;
  template <class Use>
  bool for_each_share(int i, const Use &use) const;
  void add_grain(int i);
  grainscope::SymmetryAxis axis_of(int i) const;
  void add_motion();
  void warn_of_mixture();
};

}

#endif
#endif

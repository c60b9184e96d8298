// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_LANE_LAW_H
#define GRAINSCOPE_LANE_LAW_H

#include "pair_law.h"
#include "pointers.h"
#include <string>

namespace grainscope {

/** The contact models of the pair style as a PairLaw, if many contacts can be computed side by side with them; all
 *  other models are evaluated by LIGGGHTS. */
class LaneLaw : private LAMMPS_NS::Pointers {
 public:
  explicit LaneLaw(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  /** Before a run; all ranks together. `models`: the words of the command. `spring_in_place`: in the contact history
   *  the tangential spring is where the lanes look for it, behind lambda or, without one, in the first columns. */
  void connect(const std::string &models, bool spring_in_place);
  /** `time_level synchronized`; `kept`: what is kept of a contact, behind lambda. */
  void synchronize(int kept) {
    synchronized_ = true;
    law_.kept = kept;
  }
  bool synchronized() const { return synchronized_; }
  bool covers() const { return covers_; }
  /** Material properties and time step as they are now. */
  void refresh();
  const PairLaw &law() const { return law_; }
  const PairLaw::Terms &terms(int type_i, int type_j) const {
    return law_.terms[(type_i - 1) * law_.types + type_j - 1];
  }

 private:
  bool covers_ = false, synchronized_ = false;
  PairLaw law_;
  // of the host, for each pair of atom types
  double **young_ = nullptr, **shear_ = nullptr, **beta_ = nullptr, **log_restitution_ = nullptr, **friction_ = nullptr,
         **stiffness_[4] = {};

  bool read(const std::string &models);
  PairLaw::Terms terms_of(int type_i, int type_j) const;
};

}

#endif

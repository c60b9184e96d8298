// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_LEDGER_GRAVITY_H
#define GRAINSCOPE_LEDGER_GRAVITY_H

#include <Eigen/Core>
#include <vector>

namespace LAMMPS_NS {
class FixGravity;
class LAMMPS;
}

namespace grainscope {

/** The weight that fixes gravity add to the force on each grain. Made when a run is set up. With a fix relax, which
 *  scales weights, no weight is known. */
class LedgerGravity {
 public:
  LedgerGravity() = default;
  explicit LedgerGravity(LAMMPS_NS::LAMMPS *lmp);

  bool none() const { return pulls_.empty(); }
  /** Accelerations as in the last evaluation. */
  void update();
  Eigen::Vector3d acceleration(int mask) const;

 private:
  struct Pull {
    LAMMPS_NS::FixGravity *fix;
    int group, frozen;  // bits; frozen: of fixes freeze behind it, which take its force away again
    Eigen::Vector3d acceleration;
  };
  std::vector<Pull> pulls_;
};

}

#endif

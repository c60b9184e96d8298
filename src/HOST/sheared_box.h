// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SHEARED_BOX_H
#define GRAINSCOPE_SHEARED_BOX_H

#include "pointers.h"
#include <array>
#include <memory>

namespace LAMMPS_NS {
class Irregular;
}

namespace grainscope {

/** One tilt of the host's box: its index in h and h_rate, the edges along its flow and its gradient, its name. Which
 *  tilt is meant is known by its address: `inline`, so that all files share one table. */
struct Tilt {
  int index, flow, gradient;
  const char *name;
};
inline const Tilt tilts[3] = {{5, 0, 1, "xy"}, {4, 0, 2, "xz"}, {3, 1, 2, "yz"}};

/** How fast the box deforms, in the host's order: of the edges x, y, z the change of length, dL/dt; of the tilts yz,
 *  xz, xy the true shear rate. */
using BoxRates = std::array<double, 6>;

/** Moves the host's box: its edge lengths at given speeds, symmetrically about its middle, and its tilts at given shear
 *  rates. domain->h_rate always holds the rates of the coming step: the host's ghost velocities follow it. */
class ShearedBox : private LAMMPS_NS::Pointers {
 public:
  /** `turns`: tilts (by index, as in BoxRates) that are turned back by an edge when they have grown beyond half of it;
   *  the tilt xz, which a box that is sheared in xy and yz takes on, with both. */
  ShearedBox(LAMMPS_NS::LAMMPS *lmp, const std::array<bool, 6> &turns);
  ~ShearedBox() override;

  double length(int edge) const;
  double tilt(const Tilt &which) const;
  /** Rates of the box as it is, dH/dt = L H with L_ab the shear rate in the plane ab and L_aa = (dL_a/dt)/L_a. */
  void set_rates(const BoxRates &rates);
  /** One time step, to a box that has these rates: H grows by exactly dH/dt dt, the velocities of images by which
   *  grains are wrapped after it. */
  void advance(const BoxRates &rates);
  /** A tilt beyond half the box is due to be turned back by one edge. */
  bool needs_flip() const;
  /** Turns it back, before neighbour lists are built. Grains are wrapped into the old box and then into the new one,
   *  each time with the velocity of the face that they cross. Collective. */
  void flip(const BoxRates &rates);

 private:
  std::array<bool, 6> turns_;
  std::unique_ptr<LAMMPS_NS::Irregular> irregular_;

  double &tilt_of(const Tilt &which) const;
  bool beyond_half(const Tilt &which) const;
  int turn(const Tilt &which);
};

}

#endif

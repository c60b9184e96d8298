// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SHEARED_BOX_H
#define GRAINSCOPE_SHEARED_BOX_H

#include "pointers.h"
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

/** Moves the host's box: one edge length at a given speed, symmetrically about its middle, and one tilt at a given
 *  shear rate. domain->h_rate always holds the rates of the coming step: the host's ghost velocities follow it. */
class ShearedBox : private LAMMPS_NS::Pointers {
 public:
  /** `shear` may be null: no tilt is driven. */
  ShearedBox(LAMMPS_NS::LAMMPS *lmp, int axis, const Tilt *shear);
  ~ShearedBox() override;

  double length() const;
  double tilt(const Tilt &which) const;
  /** Rates of the coming step: dL/dt along the axis, tilt by rate x (edge along the gradient). Other tilts with a
   *  component along the axis keep their shape. */
  void set_rates(double velocity, double rate);
  /** One time step at the rates that are set. */
  void advance();
  /** A tilt beyond half the box is due to be turned back by one edge. */
  bool needs_flip() const;
  /** Turns it back, before neighbour lists are built. Grains are wrapped into the old box and then into the new one,
   *  each time with the velocity of the face that they cross. Collective. */
  void flip(double velocity, double rate);

 private:
  int axis_;
  const Tilt *shear_;
  std::unique_ptr<LAMMPS_NS::Irregular> irregular_;

  double &tilt_of(const Tilt &which) const;
};

}

#endif

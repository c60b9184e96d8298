// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_HOST_BOX_H
#define GRAINSCOPE_HOST_BOX_H

namespace LAMMPS_NS {
class Domain;
}

namespace grainscope {

/** The box of LIGGGHTS and its rates: the numbers that define where ghosts are and how they move. Part of restart
 *  files. */
struct HostBox {
  double low[3] = {}, high[3] = {}, tilts[3] = {};  // tilts yz, xz, xy
  double rates[6] = {}, low_rates[3] = {};          // rates xx yy zz yz xz xy

  static HostBox of(const LAMMPS_NS::Domain *domain);
  void set(LAMMPS_NS::Domain *domain) const;
  /** Changes the position and, where the host remaps velocities, the velocity of a grain that was wrapped by `edges`
   *  box edges. */
  void wrap(const int edges[3], double position[3], double *velocity) const;
};

}

#endif

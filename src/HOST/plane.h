// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PLANE_H
#define GRAINSCOPE_PLANE_H

namespace grainscope {

class Arguments;

/** The plane of shear: axes 0, 1, 2 of the flow, of its gradient and of its vorticity. */
struct Plane {
  int flow = 0, gradient = 1, vorticity = 2;

  /** A vector by its components along flow, gradient and vorticity. */
  template <class Vector>
  Vector of(const Vector &v) const {
    return {v[flow], v[gradient], v[vorticity]};
  }
  /** Reads what follows the keyword 'plane': xy, xz or yz; with `dimension 2` xy. */
  void read(Arguments &arguments);
};

}

#endif

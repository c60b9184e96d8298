// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ELLIPSOID_OWNER_H
#define GRAINSCOPE_ELLIPSOID_OWNER_H

namespace grainscope {

class EllipsoidBodies;
struct EllipsoidSurface;

/** A pair style that owns the bodies and the surface, so that its loop can use them; under any other pair style the
 *  surface model has its own. */
struct EllipsoidOwner {
  virtual ~EllipsoidOwner() {}
  virtual EllipsoidBodies &ellipsoid_bodies() = 0;
  virtual EllipsoidSurface &ellipsoid_surface() = 0;
};

}

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_UNWRAPPED_BOX_H
#define GRAINSCOPE_UNWRAPPED_BOX_H

#include "bodies.h"
#include "box_state.h"
#include "fix_grain_record.h"
#include "atom.h"
#include "domain.h"

namespace grainscope {

/** The box now, and where grains are in it, image flags counted. */
struct UnwrappedBox {
  static constexpr int last_that_stands = 1;  // of the host's numbers for p f s m

  UnwrappedBox(const LAMMPS_NS::Domain &domain, const LAMMPS_NS::FixGrainRecord &record)
      : edges(upper_triangular(domain.h)), wrapped(upper_triangular(record.edges())) {
    // The point that the flow leaves at rest: middle heights, and along the flow a place that does not follow the tilt.
    rest = Eigen::Map<const Eigen::Vector3d>(domain.boxlo) + 0.5 * edges.diagonal();
    for (int k = 0; k < 3; k++) {
      follows_grains[k] = domain.boundary[k][0] > last_that_stands || domain.boundary[k][1] > last_that_stands;
      if (!follows_grains[k]) continue;
      edges.col(k) /= edges(k, k);
      middle[k] = rest[k];
      rest[k] = 0.0;
    }
  }
  /** Position of grain i, or of its clump, from the point at rest (from 0 across shrink-wrapped faces), unwrapped with
   *  the edges that its image flags count. */
  Eigen::Vector3d position(const LAMMPS_NS::Atom &atom, int i, const Bodies &bodies) const {
    if (const Body *body = bodies.of(i)) return body->centre + wrapped * body->boxes - rest;
    const LAMMPS_NS::tagint image = atom.image[i];
    const Eigen::Vector3d boxes((image & IMGMASK) - IMGMAX, (image >> IMGBITS & IMGMASK) - IMGMAX,
                                (image >> IMG2BITS) - IMGMAX);
    return Eigen::Map<const Eigen::Vector3d>(atom.x[i]) + wrapped * boxes - rest;
  }

  Eigen::Matrix3d edges, wrapped;
  Eigen::Vector3d rest;
  bool follows_grains[3];  // faces across this edge move with the outermost grain, and no other with them
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // of such edges now
};

}

#endif

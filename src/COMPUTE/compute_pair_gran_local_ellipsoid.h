// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS

ComputeStyle(pair/gran/local,ComputePairGranLocalEllipsoid)

#else

#ifndef LMP_COMPUTE_PAIR_GRAN_LOCAL_ELLIPSOID_H
#define LMP_COMPUTE_PAIR_GRAN_LOCAL_ELLIPSOID_H

#include "compute_pair_gran_local.h"
#include <vector>

namespace LAMMPS_NS {

/** The compute pair/gran/local of LIGGGHTS, which reads `history`, `delta` and `contactPoint` from the contact history:
 *  with `surface ellipsoid` it gets the columns of `surface superquadric`. */
class ComputePairGranLocalEllipsoid : public ComputePairGranLocal {
 public:
  using ComputePairGranLocal::ComputePairGranLocal;
  void init_cpgl(bool requestflag) override;
  void add_pair(int i, int j, double fx, double fy, double fz, double tor1, double tor2, double tor3, double *hist,
                const double *const contact_point) override;

 private:
  bool of_ellipsoids_ = false;
  std::vector<double> row_;
};

}

#endif
#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PRESS_STRAIN_FORECAST_H
#define GRAINSCOPE_PRESS_STRAIN_FORECAST_H

#include "pointers.h"
#include <vector>

namespace grainscope {

struct PressStrainSettings;

/** Reports, when a run is set up, whether the box of fix press/strain will become too small for the contact history,
 *  which needs a height of h = 2 x the cutoff of neighbour lists. The grains fill the present cross section up to h
 *  with a solid fraction phi_h, and to hold a pressure they must come into contact:
 *    phi_h < 0.45: a slow flow (I <= 0.1) of grains without cohesion and rolling friction is denser than that
 *      (Bilotto et al. 2025, Sec. II, doi 10.1103/tj41-6qqk), so the box would become lower than h: an error, if the
 *      run is long enough for it.
 *    phi_h < 0.64, of random close packings of spheres, 0.84 of discs: likely; a warning, once.
 *  Several edges under pressure are assumed to shrink alike: a warning, once, if one of them would become lower than h.
 */
class PressStrainForecast : private LAMMPS_NS::Pointers {
 public:
  PressStrainForecast(LAMMPS_NS::LAMMPS *lmp, const PressStrainSettings &settings)
      : Pointers(lmp), settings_(settings) {}

  /** Once target and rate are known and neighbour lists are built. `interval`: the time between inputs. Collective. */
  void check(double interval);

 private:
  const PressStrainSettings &settings_;
  bool warned_ = false;

  struct Grains {
    double number = 0.0, volume = 0.0, mass = 0.0, diameters = 0.0;
  };
  Grains grains() const;
  bool grains_may_change() const;
  bool flows_slowly(const Grains &grains, int edge) const;
  bool reaches(double strain, double interval) const;
  std::vector<int> pressed_edges() const;
  void check_edge(const Grains &all, int edge, double interval);
  void check_edges(const Grains &all, const std::vector<int> &edges);
  void warn(const char *message);
};

}

#endif

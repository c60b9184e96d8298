// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PRESS_STRAIN_IMPL_H
#define GRAINSCOPE_PRESS_STRAIN_IMPL_H

#include "box_jump.h"
#include "clipping_watch.h"
#include "fix_press_strain.h"
#include "network_lanes.h"
#include "press_strain_forecast.h"
#include "press_strain_settings.h"
#include <functional>

namespace grainscope {

class ContactObserver;

/** Loops of the controller: one of each mode of the box, and that of the mean pressure. */
inline constexpr int mean_loop = number_of_box_modes, loops = mean_loop + 1;

/** What inputs have set. */
struct PressStrainDriven {
  double rates[number_of_box_modes];  // of edges with a target of their own dL/dt, of tilts the shear rate
  double mean_rate;                   // common (dL/dt)/L of the edges that move with the mean, before their ratios
  double bases[loops];                // rates without what errors add to them
};

}

namespace LAMMPS_NS {

/** What fix press/strain keeps: for its own files alone. */
struct FixPressStrain::Impl {
  Impl(LAMMPS *lmp, int narg, char **arg);

  grainscope::PressStrainSettings settings;
  int dimension;
  std::vector<int> controlled;  // modes whose stiffness is wanted
  grainscope::NetworkResponse::Pairs pairs;
  grainscope::ShearedBox box;
  grainscope::Intervals intervals;
  grainscope::PressStrainForecast forecast;
  int momentum_groupbit = 1;
  std::string momentum_group;
  grainscope::ContactObserver *observer = nullptr;

  bool flip_pending = false;

  grainscope::NetworkLanes lanes;                  // of that, what came side by side
  grainscope::NetworkResponse now;                 // this rank's sums of the last evaluation, over volume
  grainscope::NetworkResponse window;              // the same since the last input
  double window_steps = 0.0, planned_steps = 0.0;  // since the last input; and until the next, as it was planned
  double strain = 0.0, averaged_pressure = 0.0, inputs = 0.0, clipped = 0.0;
  bool averaged = false;  // there was an input since the modes are what they are
  grainscope::PressStrainDriven driven{};
  double strains[grainscope::number_of_box_modes] = {}, clipped_of[grainscope::loops] = {};
  grainscope::ClippingWatch clipping[grainscope::loops];
  std::unique_ptr<grainscope::BoxJump> jump;  // of the last step
  bigint pressure_step = -1;
  std::array<double, grainscope::number_of_box_modes> pressures{};  // of that step

  bool holds(int loop) const {
    return loop == grainscope::mean_loop ? settings.has_mean
                                         : settings.motions[loop].how == grainscope::BoxMotion::How::target;
  }
  double controlled_bits() const;
  double mean_of(const std::array<double, grainscope::number_of_box_modes> &of) const;
  double main_of(const std::array<double, grainscope::number_of_box_modes> &of) const;
  double main_target() const;
  double target_of(int mode) const {
    const grainscope::BoxMotion &motion = settings.motions[mode];
    return motion.how == grainscope::BoxMotion::How::target ? motion.value.value : 0.0;
  }
  int shown_edge() const;
  double true_rate(int mode) const;
  grainscope::BoxRates rates(double ahead = 0.0) const;

  /** What an element of the vector is, and its value. */
  struct Element {
    grainscope::NamedOutput output;
    std::function<double(FixPressStrain &)> value;
  };
  static const std::vector<Element> &elements();
  static void add_edges(std::vector<Element> &all);
  static void add_planes(std::vector<Element> &all);
  static grainscope::Outputs declared();
};

}

#endif

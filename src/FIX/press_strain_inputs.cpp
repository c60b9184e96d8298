// SPDX-License-Identifier: GPL-2.0-or-later
/** The inputs of fix press/strain: new rates from the stresses averaged since the last input. */
#include "contact_observer.h"
#include "fluctuations.h"
#include "press_strain_impl.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "force.h"
#include "update.h"

using namespace LAMMPS_NS;
using grainscope::box_modes;
using grainscope::BoxMotion;
using grainscope::Fluctuations;
using grainscope::mean_loop;
using grainscope::NetworkResponse;
using grainscope::number_of_box_modes;
using grainscope::PressureControl;
using How = BoxMotion::How;

void FixPressStrain::take_input() {
  Impl &my = *impl_;
  static_assert(sizeof(NetworkResponse) == 48 * sizeof(double), "what ranks add up");
  MPI_Allreduce(MPI_IN_PLACE, &my.window, 48, MPI_DOUBLE, MPI_SUM, world);
  NetworkResponse mean;
  mean.add(my.window, 1.0 / my.window_steps);
  my.averaged_pressure = my.main_of(mean.pressure);
  my.averaged = true;
  my.window = NetworkResponse();
  my.window_steps = 0.0;

  if (my.settings.remove_momentum) {
    const Eigen::Vector3d drift =
        Fluctuations(lmp, {"fix press/strain", my.momentum_groupbit}, my.observer->box()).drift();
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & my.momentum_groupbit)
        for (int k = 0; k < 3; k++) atom->v[i][k] -= drift[k];
  }
  my.inputs += 1.0;
  my.planned_steps = std::round(time_between_inputs() / update->dt);
  if (set_driven_rates(mean)) my.clipped += 1.0;
}

/** Of all modes that are controlled, at an input; true if one was clipped. */
bool FixPressStrain::set_driven_rates(const NetworkResponse &mean) {
  Impl &my = *impl_;
  const PressureControl &control = my.settings.control;
  const double interval = time_between_inputs();
  bool clipped = false;
  const auto book = [&](int loop, const PressureControl::Input &input) {
    my.clipped_of[loop] += input.clipped ? 1.0 : 0.0;
    my.clipping[loop].watch(lmp, my.inputs, input, loop < 3 || loop == mean_loop ? "pressure" : "shear stress");
    clipped = clipped || input.clipped;
    return input.velocity;
  };
  // If one edge is driven, the others must keep moving.
  const bool edges_go_on = my.settings.drives_an_edge();
  const auto input = [&](int loop, double error, double resistance, double stiffness, double length, bool goes_on) {
    return book(loop, goes_on ? control.input_with_base(error, resistance, stiffness * interval, length, interval,
                                                        my.driven.bases[loop])
                              : control.input(error, resistance, length, interval));
  };
  for (int k = 0; k < number_of_box_modes; k++) {
    if (my.settings.motions[k].how != How::target) continue;
    const double resistance = resistance_of(mean, k, interval);
    const double stiffness = mean.stiffness[NetworkResponse::place(k, k)];
    my.driven.rates[k] =
        k < 3 ? input(k, mean.pressure[k] - my.target_of(k), resistance, stiffness, my.box.length(k), edges_go_on)
              : input(k, mean.pressure[k] + my.target_of(k), resistance + inertial_resistance(mean, k), stiffness, 1.0,
                      true);
  }
  if (my.settings.has_mean)
    my.driven.mean_rate = input(mean_loop, my.mean_of(mean.pressure) - my.settings.mean.value,
                                resistance_of(mean, mean_loop, interval), mean_stiffness(mean), 1.0, edges_go_on);
  return clipped;
}

/** Upper bound of the response of the stress of a loop to the rates of all loops together, per unit rate of each. */
double FixPressStrain::resistance_of(const NetworkResponse &mean, int loop, double interval) const {
  // |answer of mode a| to the rates of all loops
  const auto answer = [&](int a) {
    double sum = 0.0;
    for (int b = 0; b < number_of_box_modes; b++) {
      const BoxMotion &motion = impl_->settings.motions[b];
      if (motion.controlled()) sum += std::fabs(mean.resistance(a, b, interval)) * motion.ratio;
    }
    return sum;
  };
  if (loop != mean_loop) return answer(loop);
  double sum = 0.0;
  for (int a = 0; a < impl_->dimension; a++) sum += answer(a) / impl_->dimension;
  return sum;
}

/** Stiffness of the mean pressure against the common rate. */
double FixPressStrain::mean_stiffness(const NetworkResponse &mean) const {
  double sum = 0.0;
  for (int a = 0; a < impl_->dimension; a++)
    for (int b = 0; b < impl_->dimension; b++) {
      const BoxMotion &motion = impl_->settings.motions[b];
      if (motion.how == How::mean)
        sum += mean.stiffness[NetworkResponse::place(a, b)] * motion.ratio / impl_->dimension;
    }
  return sum;
}

/** Additional resistance of a shear, h sqrt(rho K): h is the edge along its gradient, rho the mass per volume of the
 *  box. It is the stiffness times the time in which sound crosses the box. Tangential springs may be undamped, and
 *  inputs in phase with their vibrations would amplify them. Collective. */
double FixPressStrain::inertial_resistance(const NetworkResponse &mean, int mode) const {
  double mass = 0.0;
  for (int i = 0; i < atom->nlocal; i++) mass += atom->rmass[i];
  MPI_Allreduce(MPI_IN_PLACE, &mass, 1, MPI_DOUBLE, MPI_SUM, world);
  const double unit = force->mvv2e * force->nktv2p, stiffness = mean.stiffness[NetworkResponse::place(mode, mode)];
  return impl_->box.length(box_modes[mode].gradient) *
         std::sqrt(mass / impl_->observer->box().volume * stiffness * unit);
}

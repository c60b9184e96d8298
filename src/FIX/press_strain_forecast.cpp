// SPDX-License-Identifier: GPL-2.0-or-later
#include "press_strain_forecast.h"
#include "arguments.h"
#include "box_state.h"
#include "contact_law.h"
#include "grain_shape.h"
#include "pair_gran_insitu.h"
#include "press_strain_settings.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace grainscope {

namespace {

const double slow = 0.1, least_of_slow_flows = 0.45;
double close_packing(int dimension) { return dimension == 2 ? 0.84 : 0.64; }

}

PressStrainForecast::Grains PressStrainForecast::grains() const {
  Grains all;
  for (int i = 0; i < atom->nlocal; i++) {
    all.number += 1.0;
    all.volume += solid_volume(*atom, i, domain->dimension);
    all.mass += atom->rmass[i];
    all.diameters += equivalent_diameter(*atom, i);
  }
  static_assert(sizeof all == 4 * sizeof(double), "what ranks add up");
  MPI_Allreduce(MPI_IN_PLACE, &all.number, 4, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

/** More grains may come. */
bool PressStrainForecast::grains_may_change() const {
  return std::any_of(modify->fix, modify->fix + modify->nfix,
                     [](const LAMMPS_NS::Fix *fix) { return !strncmp(fix->style, "insert/", 7); });
}

/** Whether the flow is slow and therefore dense: free grains without cohesion and rolling friction, sheared in one
 *  plane at a steady inertial number of at most 0.1, in a box that a controller of known gain moves along one edge. */
bool PressStrainForecast::flows_slowly(const Grains &grains, int edge) const {
  using How = BoxMotion::How;
  const BoxMotion *plane = nullptr;
  for (int k = 0; k < 3; k++)
    if (k != edge && settings_.motions[k].moves()) return false;
  for (int k = 3; k < number_of_box_modes; k++) {
    const BoxMotion &motion = settings_.motions[k];
    if (!motion.moves()) continue;
    if (plane || motion.how != How::rate) return false;
    plane = &motion;
  }
  const bool steady = plane && settings_.motions[edge].how == How::target && !settings_.follows_variables() &&
                      settings_.control.automatic;
  if (!steady || domain->dimension != 3 || !domain->xperiodic || !domain->yperiodic || !domain->zperiodic) return false;
  const auto moves = [](const LAMMPS_NS::Fix *fix) { return fix->time_integrate != 0; };
  const auto freezes = [](const LAMMPS_NS::Fix *fix) { return !strncmp(fix->style, "freeze", 6); };
  LAMMPS_NS::Fix **const begin = modify->fix, **const end = begin + modify->nfix;
  if (std::none_of(begin, end, moves) || std::any_of(begin, end, freezes)) return false;
  const ContactLaw &law = LAMMPS_NS::PairGranInsitu::required_by(lmp, "fix press/strain")->law();
  if (law.cohesive || law.rolls) return false;
  const double rho = grains.mass / grains.volume, d = grains.diameters / grains.number;
  const double pressure = settings_.motions[edge].value.value / (force->mvv2e * force->nktv2p);
  return std::fabs(plane->value.value) * d * std::sqrt(rho / pressure) <= slow;
}

/** Whether the run is long enough for the box to shrink by this logarithmic strain. */
bool PressStrainForecast::reaches(double strain, double interval) const {
  const double fastest = std::min(settings_.control.limit / interval, settings_.control.max_rate);
  return (update->laststep - update->ntimestep) * update->dt * fastest >= strain;
}

/** Edges that a pressure above 0 moves. */
std::vector<int> PressStrainForecast::pressed_edges() const {
  using How = BoxMotion::How;
  std::vector<int> edges;
  for (int k = 0; k < 3; k++) {
    const BoxMotion &motion = settings_.motions[k];
    if ((motion.how == How::target && motion.value.value > 0.0) ||
        (motion.how == How::mean && settings_.mean.value > 0.0))
      edges.push_back(k);
  }
  return edges;
}

void PressStrainForecast::check(double interval) {
  const bool history = LAMMPS_NS::PairGranInsitu::required_by(lmp, "fix press/strain")->is_history();
  const std::vector<int> edges = pressed_edges();
  if (!history || edges.empty() || grains_may_change()) return;
  const Grains all = grains();
  if (all.number == 0.0) return;
  if (edges.size() == 1) check_edge(all, edges.front(), interval);
  else check_edges(all, edges);
}

/** Edges that shrink alike, until the grains are packed as closely as they can be. */
void PressStrainForecast::check_edges(const Grains &all, const std::vector<int> &edges) {
  if (warned_) return;
  const BoxState box(lmp);
  const double close = close_packing(domain->dimension), needed = 2.0 * neighbor->cutneighmax;
  const double shrinks = std::pow(all.volume / (close * box.volume), 1.0 / edges.size());
  for (int edge : edges) {
    const double height = box.height(edge) * shrinks;
    if (height >= needed) continue;
    char numbers[384];
    snprintf(
        numbers, sizeof numbers,
        "the box may become too small: at a solid fraction of %g these %.0f grains make it %.6g high along %c, and "
        "contact history needs 2 x (largest diameter x contact distance factor + skin) = %.6g. Take more grains",
        close, all.number, height, "xyz"[edge], needed);
    return warn(numbers);
  }
}

void PressStrainForecast::check_edge(const Grains &all, int edge, double interval) {
  const BoxState box(lmp);
  const double height = box.height(edge), needed = 2.0 * neighbor->cutneighmax;
  const double area = box.volume / height, phi = all.volume / (area * needed);
  const bool certain =
      phi < least_of_slow_flows && flows_slowly(all, edge) && reaches(std::log(height / needed), interval);
  if (!certain && (warned_ || phi >= close_packing(domain->dimension))) return;
  const double bound = certain ? least_of_slow_flows : close_packing(domain->dimension);
  char numbers[384];
  snprintf(numbers, sizeof numbers,
           "the box %s too small: at a solid fraction of %g these %.0f grains fill it up to a height of %.6g along %c, "
           "and contact history needs 2 x (largest diameter x contact distance factor + skin) = %.6g. Take %.0f grains "
           "or more, or a box that is narrower across %c",
           certain ? "becomes" : "may become", bound, all.number, all.volume / (area * bound), "xyz"[edge], needed,
           std::ceil(all.number * close_packing(domain->dimension) / phi), "xyz"[edge]);
  if (certain) Arguments(lmp, "fix press/strain").fail(numbers);
  warn(numbers);
}

void PressStrainForecast::warn(const char *message) {
  warned_ = true;
  if (comm->me == 0) error->warning(FLERR, ("fix press/strain: " + std::string(message)).c_str());
}

}

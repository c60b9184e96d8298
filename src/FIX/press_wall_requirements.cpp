// SPDX-License-Identifier: GPL-2.0-or-later
#include "press_wall_requirements.h"
#include "arguments.h"
#include "box_state.h"
#include "contact_law.h"
#include "press_wall_settings.h"
#include "pressed_mesh.h"
#include "wall_reach.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "neighbor.h"
#include "update.h"
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace grainscope {

namespace {

const char *const who = "fix press/wall";
const double hardly_smaller = 0.99;
const int last_that_stands = 1;  // of the host's numbers for the boundaries p f s m

}

void PressWallRequirements::require_area() const {
  if (settings_.area > 0.0) return;
  const int axis = settings_.axis;
  const BoxState box(lmp);
  for (int k = 0; k < 3; k++) {
    if (k == axis || (k == 2 && domain->dimension == 2)) continue;
    const bool follows = std::max(domain->boundary[k][0], domain->boundary[k][1]) > last_that_stands;
    const std::string why = follows                     ? "is shrink-wrapped along"
                            : box.edges(axis, k) != 0.0 ? "is not at right angles to the axis along"
                                                        : "";
    if (!why.empty())
      Arguments(lmp, who).fail("'area box' cannot be used, because the box " + why + " " + "xyz"[k] +
                               ": give the area of the plate");
  }
}

void PressWallRequirements::warn_of_smaller_plate() {
  if (settings_.area > 0.0 || warned_) return;
  const BoxState box(lmp);
  const std::vector<Wall> walls = walls_of(lmp);
  for (std::size_t n = 0; n < walls.size(); n++) {
    if (!mesh_.has(n)) continue;
    const WallReach plate = WallReach::of(walls[n], world).in(box);
    double share = 1.0;
    for (int k = 0; k < box.dimension; k++)
      if (k != settings_.axis) share *= (plate.high[k] - plate.low[k]) / box.edges(k, k);
    const std::string bounds = walls_that_bound(walls[n], box, lmp);
    if (share > hardly_smaller && bounds.empty()) continue;
    warned_ = true;
    const std::string message =
        std::string(who) + ": 'area box' divides by the cross-section of the box, but the plate '" + walls[n].name +
        "' " +
        (share > hardly_smaller ? "meets inside the box: " + bounds : "spans " + Arguments::text(share) + " of it") +
        ". If grains touch a smaller area the pressure on it is larger than the target: give that area by 'area A'";
    if (comm->me == 0) error->warning(FLERR, message.c_str());
  }
}

void PressWallRequirements::require_known_stiffness() const {
  if (!settings_.control.automatic && !settings_.base) return;
  const std::vector<Wall> walls = walls_of(lmp);
  for (std::size_t k = 0; k < walls.size(); k++)
    if (mesh_.has(k) && walls[k].law && !walls[k].law->knows_stiffness())
      Arguments(lmp, who).fail(
          (settings_.base ? "'base yes'" : "'gain auto'") + std::string(" works with the normal models ") +
          ContactLaw::elastic_models() + " only: " + (settings_.base ? "leave it out" : "give a number") +
          ", or change the models of wall '" + walls[k].name + "', got '" + walls[k].law->models + "'");
}

double PressWallRequirements::side_of_grains(double toward, int groupbit) const {
  double sides[3] = {0.0, 0.0, 0.0};  // grains below, above, and where the plate is
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double at = atom->x[i][settings_.axis];
    sides[at < mesh_.low() ? 0 : at > mesh_.high() ? 1 : 2] += 1.0;
  }
  MPI_Allreduce(MPI_IN_PLACE, sides, 3, MPI_DOUBLE, MPI_SUM, world);
  const auto count = [&sides](int k) { return Arguments::text(sides[k]); };
  const bool below = sides[0] > 0.0, above = sides[1] > 0.0, beside = sides[2] > 0.0;
  const Arguments errors(lmp, who);
  if (toward != 0.0) {
    const bool wrong = !beside && (toward > 0.0 ? below && !above : above && !below);
    if (wrong)
      errors.fail(std::string("mesh '") + settings_.mesh + "' is pushed toward " + (toward > 0.0 ? "+" : "-") +
                  ", but all " + count(below ? 0 : 1) + " grains are on its other side");
    return toward;
  }
  if (beside || below == above)
    errors.fail("'toward +' or 'toward -' is required where the grains of its group are not all on one side of the "
                "mesh, got " +
                count(0) + " below it along the axis, " + count(1) + " above it, and " + count(2) +
                " between its ends");
  return above ? 1.0 : -1.0;
}

void PressWallRequirements::require_slow_plate(double interval) const {
  const PressureControl &control = settings_.control;
  const Arguments errors(lmp, who);
  if (!std::isfinite(control.limit))
    errors.fail("'limit' and a distance are required: the default is the size of the grains, and there are none yet");
  const double step = update->dt * std::min(control.limit / interval, control.max_rate);
  if (step > 0.5 * neighbor->skin)
    errors.fail(
        "'limit' and 'maxrate' must keep the motion of the plate in a step at or below half of the neighbour skin, " +
        Arguments::text(0.5 * neighbor->skin) + ", got " + Arguments::text(step));
}

}

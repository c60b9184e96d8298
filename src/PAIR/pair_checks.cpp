// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_checks.h"
#include "bin_index.h"
#include "box_state.h"
#include "restart_data.h"
#include "state_block.h"
#include "symmetry_axis.h"
#include "two_dimensions.h"
#include "wall_contacts_owner.h"
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

const double rounding = 1e-9;  // of positions that are equal, over the radius

/** What contacts with a wall, or a style of ours, go on with after a restart, by what an input script calls it; "":
 *  something else. `ours`: of a style that LIGGGHTS knows by the name of one of its own. */
std::string continued(const std::string &id, const std::string &style, bool ours) {
  const auto begins = [&id](const char *prefix) { return id.compare(0, strlen(prefix), prefix) == 0; };
  const auto without = [&id](const char *ending) { return " '" + id.substr(0, id.size() - strlen(ending)) + "'"; };
  if (style == "property/atom" && begins("history_")) return "springs at wall '" + id.substr(strlen("history_")) + "'";
  if (style == "contacthistory/mesh") return "springs at wall '" + id.substr(strlen("tracker_")) + "'";
  if (style == "grain/record") return "memory of compute" + without("_record");
  if (style == "ledger/record") return "ledger of compute" + without("_ledger");
  if (ours && style == "deform") return "state of fix press/strain '" + id + "'";
  if (ours && style == "move/mesh") return "state of fix press/wall '" + id + "'";
  return "";
}

}

void PairChecks::require_same_columns_in_restart(int wanted, std::initializer_list<ColumnSetting> settings) const {
  const char *state = RestartData::of(modify, "contacthistory");
  if (!state) return;
  const int found = static_cast<int>(whole_count(RestartData::first_number(state), 1e6));
  for (const ColumnSetting &setting : settings) {
    if (setting.columns == 0 || found != wanted + (setting.on ? -setting.columns : setting.columns)) continue;
    const std::string with = std::string("'") + setting.keyword + " " + setting.with + "'",
                      without = std::string("'") + setting.keyword + " " + setting.without + "'";
    error->all(FLERR, ("pair_style gran/insitu: the restart file holds " + std::to_string(found) +
                       " numbers per contact, and this pair_style has " + std::to_string(wanted) +
                       ": if the contact models are the same, it was written with" +
                       (setting.on ? "out " + with + ". Use " + without + ", or write the restart file with " + with
                                   : " " + with + ". Use " + with))
                          .c_str());
  }
}

void PairChecks::warn_of_lost_states() {
  const std::vector<RestartData::Entry> saved = RestartData::all(modify);
  if (saved.empty()) return;
  const auto is_there = [this](const RestartData::Entry &entry) {
    const int at = modify->find_fix(entry.id.c_str());
    return at >= 0 && entry.style == modify->fix[at]->style;
  };
  for (int k = 0; k < modify->nfix; k++) {
    const LAMMPS_NS::Fix &fix = *modify->fix[k];
    // those of LIGGGHTS have no outputs
    const std::string begins = continued(fix.id, fix.style, fix.scalar_flag),
                      kind = begins.substr(0, begins.find('\''));
    if (begins.empty() || fix.recent_restart) continue;
    for (const RestartData::Entry &entry : saved) {
      const std::string lost = continued(entry.id, entry.style, state_block::is_one(entry.state));
      if (lost.empty() || lost.compare(0, kind.size(), kind) != 0 || is_there(entry)) continue;
      const std::string message = "the restart file holds the " + lost + ", which is not in this run, and not the " +
                                  begins + ": if one is to continue the other, give it the same ID";
      if (comm->me == 0) error->warning(FLERR, message.c_str());
    }
  }
}

void PairChecks::require_consistent_units() const {
  if (force->nktv2p != 1.0)
    Arguments(lmp, "pair_style gran/insitu").fail("units", "consistent: si, cgs, lj or micro", update->unit_style);
}

void PairChecks::warn_of_stale_springs() {
  if (warned_of_stale_springs_ || neighbor->contactDistanceFactor > 1.0) return;
  int spheres = atom->sphere_flag;
  if (atom->superquadric_flag)
    for (int i = 0; i < atom->nlocal && !spheres; i++)
      spheres = atom->shape[i][0] == atom->shape[i][1] && atom->shape[i][1] == atom->shape[i][2];
  int any = 0;
  MPI_Allreduce(&spheres, &any, 1, MPI_INT, MPI_MAX, world);
  if (!any) return;
  warned_of_stale_springs_ = true;
  if (comm->me == 0)
    error->warning(
        FLERR,
        "spheres at contact distance factor 1.0 keep the tangential spring of a contact that has opened, until the "
        "next neighbour list: add the line 'neigh_modify contact_distance_factor 1.05'");
}

void PairChecks::warn_of_unseen_walls() {
  std::string walls;
  for (int k = 0; k < modify->nfix; k++) {
    LAMMPS_NS::Fix *const fix = modify->fix[k];
    if (strncmp(fix->style, "wall/", 5) || dynamic_cast<WallContactsOwner *>(fix)) continue;
    walls += (walls.empty() ? "fix " : ", fix ") + std::string(fix->id) + " (" + fix->style + ")";
  }
  const bool news = !walls.empty() && walls != warned_of_walls_;
  warned_of_walls_ = walls;
  if (!news || comm->me != 0) return;
  error->warning(FLERR, ("pair_style gran/insitu: contacts with the walls of " + walls +
                         " are not measured, only those of fix wall/gran are")
                            .c_str());
}

void PairChecks::warn_of_sphere_model(const std::string &model) {
  if (model.empty() || warned_of_sphere_model_) return;
  int any = 0;
  for (int i = 0; i < atom->nlocal && !any; i++) any = symmetry_axis(atom->shape[i]).shape != Shape::sphere;
  MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, world);
  if (!any) return;
  const std::string message = "pair_style gran/insitu: '" + model +
                              "' takes its geometry from the distance of centres and the radii of spheres: with "
                              "surface superquadric its forces on grains that are not spheres are wrong. Use 'surface "
                              "ellipsoid', which gives sjkr and sjkr2 the overlap and effective radius of the contact";
  if (comm->me == 0) error->warning(FLERR, message.c_str());
  warned_of_sphere_model_ = true;
}

void PairChecks::require_grains_in_plane() const {
  if (domain->dimension != 2) return;
  const Arguments errors(lmp, "pair_style gran/insitu");
  require_grains_of_dimension(lmp, errors);
  int held = 0;  // by fixes enforce2d
  for (int k = 0; k < modify->nfix; k++)
    if (!strcmp(modify->fix[k]->style, "enforce2d")) held |= modify->fix[k]->groupbit;
  double extremes[3] = {-HUGE_VAL, -HUGE_VAL, 0.0};  // highest z, -lowest z, largest radius
  int loose = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    extremes[0] = std::max(extremes[0], atom->x[i][2]);
    extremes[1] = std::max(extremes[1], -atom->x[i][2]);
    extremes[2] = std::max(extremes[2], atom->radius[i]);
    const bool stays = atom->v[i][2] == 0.0 && atom->omega[i][0] == 0.0 && atom->omega[i][1] == 0.0;
    if (!stays && !(atom->mask[i] & held)) loose++;
  }
  MPI_Allreduce(MPI_IN_PLACE, extremes, 3, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(MPI_IN_PLACE, &loose, 1, MPI_INT, MPI_SUM, world);
  if (extremes[0] + extremes[1] > rounding * extremes[2])
    errors.fail("with 'dimension 2' all grains must be at one z, got " + Arguments::text(-extremes[1]) + " to " +
                Arguments::text(extremes[0]));
  if (loose)
    errors.fail("with 'dimension 2' grains must have no velocity along z and no spin about x and y, got " +
                std::to_string(loose) + " that move so and are not held by a fix enforce2d");
}

void PairChecks::require_box_large_enough() const {
  const BoxState box(lmp);
  const double needed = 2.0 * neighbor->cutneighmax;
  for (int k = 0; k < domain->dimension; k++)
    if (box.periodic[k] && box.height(k) < needed) {
      char message[256];
      snprintf(message, sizeof message,
               "pair_style gran/insitu: the periodic box must be at least 2 x (largest diameter x contact distance "
               "factor + skin) = %g high along %c, got %g: two images of one grain could touch the same neighbour",
               needed, "xyz"[k], box.height(k));
      error->all(FLERR, message);
    }
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "ledger_grains.h"
#include "contact_observer.h"
#include "fix_wall_gran_insitu.h"
#include "pair_gran_insitu.h"
#include "atom.h"
#include "fix_contact_history_mesh.h"
#include "fix_mesh_surface.h"
#include "fix_property_atom.h"
#include "neigh_list.h"
#include <algorithm>
#include <iterator>

namespace grainscope {

using LAMMPS_NS::Atom;

namespace {

bool has(const std::vector<int> &sorted, int tag) { return std::binary_search(sorted.begin(), sorted.end(), tag); }

std::vector<int> difference(const std::vector<int> &a, const std::vector<int> &b) {
  std::vector<int> rest;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(rest));
  return rest;
}

/** Those of all ranks, sorted. */
std::vector<int> gathered(const std::vector<int> &mine, MPI_Comm world) {
  int ranks, n = mine.size();
  MPI_Comm_size(world, &ranks);
  std::vector<int> counts(ranks), starts(ranks, 0);
  MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int k = 1; k < ranks; k++) starts[k] = starts[k - 1] + counts[k - 1];
  std::vector<int> all(starts.back() + counts.back());
  MPI_Allgatherv(mine.data(), n, MPI_INT, all.data(), counts.data(), starts.data(), MPI_INT, world);
  std::sort(all.begin(), all.end());
  return all;
}

}

void LedgerGrains::add_contact(const ContactLaw &law, const double *history, double stamp, double weight,
                               EnergyLedger::Partner partner, int tag, int other_tag) {
  const double *const past = history + law.past_column;
  if (past[0] != stamp) return;
  double spring = 0.0;
  if (law.tangential == TangentialLaw::spring)
    spring = 0.5 * past[3] * Eigen::Map<const Eigen::Vector3d>(history + law.spring_column).squaredNorm();
  contacts_.push_back({{tag, other_tag},
                       partner,
                       weight * past[2] * past[1] / (1.0 + law.exponent),
                       weight * spring,
                       weight * past[4],
                       weight * past[5]});
}

void LedgerGrains::read_contacts(LAMMPS_NS::LAMMPS *lmp, LAMMPS_NS::PairGranInsitu &pair, int groupbit) {
  const Atom &atom = *lmp->atom;
  const double stamp = pair.observer().stamp();
  const LAMMPS_NS::NeighList &list = *pair.list, &history = *pair.listgranhistory;
  for (int ii = 0; ii < list.inum; ii++) {
    const int i = list.ilist[ii];
    if (!(atom.mask[i] & groupbit)) continue;
    for (int jj = 0; jj < list.numneigh[i]; jj++) {
      const int j = list.firstneigh[i][jj];
      if (atom.mask[j] & groupbit)
        add_contact(pair.law(), history.firstdouble[i] + jj * history.dnum, stamp, j < atom.nlocal ? 1.0 : 0.5,
                    EnergyLedger::grains, atom.tag[i], atom.tag[j]);
    }
  }
  for (const Wall &wall : walls_of(lmp))
    for (int i = 0; i < atom.nlocal; i++) {
      if (!(atom.mask[i] & groupbit)) continue;
      const auto add = [&](const double *numbers) {
        add_contact(*wall.law, numbers, stamp, 1.0, EnergyLedger::walls, atom.tag[i], no_tag);
      };
      if (wall.history) add(wall.history->array_atom[i]);
      LAMMPS_NS::FixContactHistoryMesh *const touched = wall.mesh ? wall.mesh->contactHistory() : nullptr;
      for (int k = 0; touched && k < touched->nneighs(i); k++)
        if (touched->get_partner_idTri(i, k) >= 0) add(touched->contacthistory(i, k));
    }
}

std::vector<int> LedgerGrains::not_in(LedgerGrains &other) {
  std::sort(grains_.begin(), grains_.end());
  std::sort(other.grains_.begin(), other.grains_.end());
  std::vector<Grain> rest;
  std::set_difference(grains_.begin(), grains_.end(), other.grains_.begin(), other.grains_.end(),
                      std::back_inserter(rest));
  std::vector<int> tags;
  tags.reserve(rest.size());
  for (const Grain &grain : rest) tags.push_back(grain.tag);
  return tags;
}

EnergyLedger::Passage LedgerGrains::taken_by(const std::vector<int> &tags, bool work) const {
  EnergyLedger::Passage taken;
  for (const Grain &grain : grains_)
    if (has(tags, grain.tag)) taken.kinetic += grain.kinetic;
  for (const StoredEnergy &c : contacts_) {
    if (!has(tags, c.tags[0]) && !has(tags, c.tags[1])) continue;
    taken.normal[c.partner] += c.normal + (work ? c.normal_work : 0.0);
    taken.spring[c.partner] += c.spring + (work ? c.spring_work : 0.0);
  }
  return taken;
}

void LedgerGrains::forget(const std::vector<int> &tags) {
  const auto gone = [&](const Grain &grain) { return has(tags, grain.tag); };
  const auto opened = [&](const StoredEnergy &c) { return has(tags, c.tags[0]) || has(tags, c.tags[1]); };
  for (const Grain &grain : grains_)
    if (gone(grain)) marks_ -= mark(grain.tag);
  grains_.erase(std::remove_if(grains_.begin(), grains_.end(), gone), grains_.end());
  contacts_.erase(std::remove_if(contacts_.begin(), contacts_.end(), opened), contacts_.end());
}

PassedGrains::PassedGrains(LedgerGrains &before, LedgerGrains &now, MPI_Comm world) {
  std::uint64_t difference_of_marks = now.marks() - before.marks();
  MPI_Allreduce(MPI_IN_PLACE, &difference_of_marks, 1, MPI_UINT64_T, MPI_SUM, world);
  if (difference_of_marks == 0) return;
  const std::vector<int> gone = gathered(before.not_in(now), world), fresh = gathered(now.not_in(before), world);
  left = difference(gone, fresh);
  came = difference(fresh, gone);
}

}

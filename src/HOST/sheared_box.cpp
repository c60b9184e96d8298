// SPDX-License-Identifier: GPL-2.0-or-later
#include "sheared_box.h"
#include "atom.h"
#include "domain.h"
#include "irregular.h"
#include "update.h"
#include <algorithm>
#include <cmath>

namespace grainscope {

namespace {

const Tilt &xy = tilts[0], &xz = tilts[1], &yz = tilts[2];

}

ShearedBox::ShearedBox(LAMMPS_NS::LAMMPS *lmp, const std::array<bool, 6> &turns) : Pointers(lmp), turns_(turns) {
  turns_[xz.index] = turns_[xz.index] || (turns_[xy.index] && turns_[yz.index]);
  if (std::find(turns_.begin(), turns_.end(), true) != turns_.end()) irregular_.reset(new LAMMPS_NS::Irregular(lmp));
}

ShearedBox::~ShearedBox() {}

double ShearedBox::length(int edge) const { return domain->prd[edge]; }

double &ShearedBox::tilt_of(const Tilt &which) const {
  return which.index == 5 ? domain->xy : which.index == 4 ? domain->xz : domain->yz;
}

double ShearedBox::tilt(const Tilt &which) const { return domain->triclinic ? tilt_of(which) : 0.0; }

void ShearedBox::set_rates(const BoxRates &rates) {
  for (int k = 0; k < 6; k++) domain->h_rate[k] = 0.0;
  for (int k = 0; k < 3; k++) {
    domain->h_rate[k] = rates[k];
    domain->h_ratelo[k] = -0.5 * rates[k];
  }
  if (!domain->triclinic) return;
  for (const Tilt &one : tilts) {
    double &rate = domain->h_rate[one.index];
    if (rates[one.flow] != 0.0) rate += tilt_of(one) * rates[one.flow] / domain->prd[one.flow];
    if (rates[one.index] != 0.0) rate += rates[one.index] * domain->prd[one.gradient];
  }
  if (rates[xy.index] != 0.0) domain->h_rate[xz.index] += rates[xy.index] * tilt_of(yz);
}

void ShearedBox::advance(const BoxRates &rates) {
  const double dt = update->dt;
  double growth[3];
  for (int k = 0; k < 3; k++) {
    const double half = 0.5 * rates[k] * dt, before = domain->prd[k];
    domain->boxlo[k] -= half;
    domain->boxhi[k] += half;
    growth[k] = rates[k] == 0.0 ? 1.0 : (domain->boxhi[k] - domain->boxlo[k]) / before;
  }
  // a tilt grows with the edge along it, and by the shear of the box after the step
  if (domain->triclinic)
    for (const Tilt *one : {&yz, &xz, &xy}) {
      double shear = rates[one->index] * (domain->boxhi[one->gradient] - domain->boxlo[one->gradient]);
      if (one == &xz) shear += rates[xy.index] * tilt_of(yz);
      tilt_of(*one) = tilt_of(*one) * growth[one->flow] + shear * growth[one->flow] * dt;
    }
  domain->set_global_box();
  domain->set_local_box();
  set_rates(rates);
}

bool ShearedBox::beyond_half(const Tilt &which) const {
  return turns_[which.index] && std::fabs(tilt_of(which)) > 0.5 * domain->prd[which.flow];
}

bool ShearedBox::needs_flip() const {
  return std::any_of(std::begin(tilts), std::end(tilts), [this](const Tilt &one) { return beyond_half(one); });
}

/** Turns one tilt back; by how many edges, -1, 0 or 1. */
int ShearedBox::turn(const Tilt &which) {
  if (!beyond_half(which)) return 0;
  const int edges = tilt_of(which) > 0.0 ? -1 : 1;
  tilt_of(which) += edges * domain->prd[which.flow];
  return edges;
}

void ShearedBox::flip(const BoxRates &rates) {
  domain->x2lamda(atom->nlocal);
  domain->pbc();
  domain->lamda2x(atom->nlocal);

  // the third edge by whole second ones, then what is left of it and the second by whole first ones
  const int of_yz = turn(yz);
  domain->xz += of_yz * domain->xy;
  const int of_xz = turn(xz), of_xy = turn(xy);
  domain->set_global_box();
  domain->set_local_box();
  set_rates(rates);
  domain->image_flip(of_xy, of_xz, of_yz);

  domain->x2lamda(atom->nlocal);
  domain->pbc();
  irregular_->migrate_atoms();
  domain->lamda2x(atom->nlocal);
}

}

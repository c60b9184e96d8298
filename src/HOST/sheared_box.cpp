// SPDX-License-Identifier: GPL-2.0-or-later
#include "sheared_box.h"
#include "atom.h"
#include "domain.h"
#include "irregular.h"
#include "update.h"
#include <cmath>

namespace grainscope {

ShearedBox::ShearedBox(LAMMPS_NS::LAMMPS *lmp, int axis, const Tilt *shear)
    : Pointers(lmp), axis_(axis), shear_(shear) {
  if (shear) irregular_.reset(new LAMMPS_NS::Irregular(lmp));
}

ShearedBox::~ShearedBox() {}

double ShearedBox::length() const { return domain->prd[axis_]; }

double &ShearedBox::tilt_of(const Tilt &which) const {
  return which.index == 5 ? domain->xy : which.index == 4 ? domain->xz : domain->yz;
}

double ShearedBox::tilt(const Tilt &which) const { return domain->triclinic ? tilt_of(which) : 0.0; }

void ShearedBox::set_rates(double velocity, double rate) {
  for (int k = 0; k < 6; k++) domain->h_rate[k] = 0.0;
  for (int k = 0; k < 3; k++) domain->h_ratelo[k] = 0.0;
  domain->h_rate[axis_] = velocity;
  domain->h_ratelo[axis_] = -0.5 * velocity;
  if (!domain->triclinic) return;
  for (const Tilt &one : tilts) {
    if (one.flow == axis_) domain->h_rate[one.index] += tilt_of(one) * velocity / domain->prd[axis_];
    if (&one == shear_) domain->h_rate[one.index] += rate * domain->prd[one.gradient];
  }
}

void ShearedBox::advance() {
  const double dt = update->dt, half = 0.5 * domain->h_rate[axis_] * dt;
  domain->boxlo[axis_] -= half;
  domain->boxhi[axis_] += half;
  if (domain->triclinic)
    for (const Tilt &one : tilts) tilt_of(one) += domain->h_rate[one.index] * dt;
  domain->set_global_box();
  domain->set_local_box();
}

bool ShearedBox::needs_flip() const { return shear_ && std::fabs(tilt_of(*shear_)) > 0.5 * domain->prd[shear_->flow]; }

void ShearedBox::flip(double velocity, double rate) {
  domain->x2lamda(atom->nlocal);
  domain->pbc();
  domain->lamda2x(atom->nlocal);

  const int turn = tilt_of(*shear_) > 0.0 ? -1 : 1;
  tilt_of(*shear_) += turn * domain->prd[shear_->flow];
  domain->set_global_box();
  domain->set_local_box();
  set_rates(velocity, rate);
  domain->image_flip(shear_->index == 5 ? turn : 0, shear_->index == 4 ? turn : 0, shear_->index == 3 ? turn : 0);

  domain->x2lamda(atom->nlocal);
  domain->pbc();
  irregular_->migrate_atoms();
  domain->lamda2x(atom->nlocal);
}

}

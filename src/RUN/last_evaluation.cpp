// SPDX-License-Identifier: GPL-2.0-or-later
#include "last_evaluation.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include <algorithm>
#include <vector>

namespace grainscope {

void LastEvaluation::note() {
  box_ = HostBox::of(domain);
  grains.note_evaluation();
}

void LastEvaluation::swap() {
  const HostBox now = HostBox::of(domain);
  box_.set(domain);
  box_ = now;
  grains.swap_evaluation();
  comm->forward_comm();
}

void LastEvaluation::begin_repetition() {
  repeats_ = true;
  grains.restore_positions(box_);
}

void LastEvaluation::end_repetition() {
  if (repeats_) grains.restore_forces();
  repeats_ = false;
}

void LastEvaluation::wrap_grains() {
  const int n = atom->nlocal;
  if (n == 0) return;
  const std::vector<double> positions(atom->x[0], atom->x[0] + 3 * n);
  const std::vector<LAMMPS_NS::tagint> images(atom->image, atom->image + n);
  if (domain->triclinic) domain->x2lamda(n);
  domain->pbc();
  if (domain->triclinic) domain->lamda2x(n);
  for (int i = 0; i < n; i++) {
    if (atom->image[i] == images[i]) std::copy(&positions[3 * i], &positions[3 * i] + 3, atom->x[i]);
    else grains.wrap(i, images[i], box_);
  }
}

}

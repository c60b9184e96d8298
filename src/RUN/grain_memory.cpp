// SPDX-License-Identifier: GPL-2.0-or-later
#include "grain_memory.h"
#include "grain_state.h"
#include "atom.h"
#include "domain.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace grainscope {

using LAMMPS_NS::tagint;

static_assert(sizeof(RememberedGrain) == GrainMemory::width * sizeof(double) &&
                  std::is_trivially_copyable<RememberedGrain>::value,
              "nothing but doubles");

namespace {

const double same_position = 1e-9;  // of the box: what the host's wrapping may change, and no command means

tagint image_of(const RememberedGrain &grain) {
  tagint image;
  std::memcpy(&image, &grain.end_image, sizeof image);
  return image;
}

}

void GrainMemory::write(int i, double *numbers) const { std::memcpy(numbers, &grains_[i], sizeof grains_[i]); }

void GrainMemory::read(int i, const double *numbers) { std::memcpy(&grains_[i], numbers, sizeof grains_[i]); }

void GrainMemory::note_evaluation() {
  for (int i = 0; i < atom->nlocal; i++) {
    std::copy(atom->x[i], atom->x[i] + 3, grains_[i].position);
    std::copy(atom->v[i], atom->v[i] + 3, grains_[i].velocity);
    std::copy(atom->omega[i], atom->omega[i] + 3, grains_[i].spin);
  }
}

void GrainMemory::note_end_of_step() {
  for (int i = 0; i < atom->nlocal; i++) {
    RememberedGrain &grain = grains_[i];
    grain.known = 1.0;
    std::copy(atom->f[i], atom->f[i] + 3, grain.force);
    std::copy(atom->torque[i], atom->torque[i] + 3, grain.torque);
    std::copy(atom->x[i], atom->x[i] + 3, grain.end_position);
    grain.end_image = 0.0;
    std::memcpy(&grain.end_image, &atom->image[i], sizeof atom->image[i]);
    grain.velocity_hash = velocity_hash(atom, i);
    grain.state_hash = state_hash(atom, i);
  }
}

void GrainMemory::swap_evaluation() {
  for (int i = 0; i < atom->nlocal; i++) {
    std::swap_ranges(atom->x[i], atom->x[i] + 3, grains_[i].position);
    std::swap_ranges(atom->v[i], atom->v[i] + 3, grains_[i].velocity);
    std::swap_ranges(atom->omega[i], atom->omega[i] + 3, grains_[i].spin);
  }
}

void GrainMemory::restore_positions(const HostBox &box) {
  for (int i = 0; i < atom->nlocal; i++) {
    const tagint before = image_of(grains_[i]);
    // Looking whether to wrap cost a few bits.
    if (before == atom->image[i]) std::copy(grains_[i].end_position, grains_[i].end_position + 3, atom->x[i]);
    else wrap(i, before, box);
  }
}

void GrainMemory::restore_forces() const {
  for (int i = 0; i < atom->nlocal; i++) {
    std::copy(grains_[i].force, grains_[i].force + 3, atom->f[i]);
    std::copy(grains_[i].torque, grains_[i].torque + 3, atom->torque[i]);
  }
}

void GrainMemory::wrap(int i, tagint image_before, const HostBox &box) {
  int edges[3];
  edges_crossed(image_before, atom->image[i], edges);
  const bool remapped = domain->deform_vremap && (atom->mask[i] & domain->deform_groupbit);
  box.wrap(edges, grains_[i].position, remapped ? grains_[i].velocity : nullptr);
}

bool GrainMemory::unchanged(int i) const {
  const RememberedGrain &grain = grains_[i];
  if (grain.known != 1.0 || grain.state_hash != state_hash(atom, i)) return false;
  const tagint before = image_of(grain);
  if (before == atom->image[i] && grain.velocity_hash != velocity_hash(atom, i)) return false;
  int n[3];
  edges_crossed(before, atom->image[i], n);
  const double shift[3] = {n[0] * domain->xprd + n[1] * domain->xy + n[2] * domain->xz,
                           n[1] * domain->yprd + n[2] * domain->yz, n[2] * domain->zprd};
  for (int k = 0; k < 3; k++)
    if (!(std::fabs(atom->x[i][k] - grain.end_position[k] + shift[k]) <= same_position * domain->prd[k])) return false;
  return true;
}

}

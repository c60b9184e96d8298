// SPDX-License-Identifier: GPL-2.0-or-later
#include "ellipsoid_bodies.h"
#include "symmetry_axis.h"
#include "atom.h"
#include "comm.h"
#include "error.h"
#include "neighbor.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace grainscope {

void EllipsoidBodies::prepare() {
  const int n = atom->nlocal + atom->nghost;
  if (neighbor->ago == 0 || list_ != neighbor->lastcall) {
    refuse_other_blockiness();
    read_shapes(n);
    list_ = neighbor->lastcall;
  }
  for (int i = 0; i < n; i++) rotated_axis(atom->quaternion[i], grains_[i].axis, grains_[i].spheroid.u);
  if (frames_.empty()) return;
  for (int i = 0; i < n; i++) frames_[i] = make_triaxial(atom->shape[i], atom->quaternion[i]);
}

void EllipsoidBodies::read_shapes(int n) {
  grains_.resize(n);
  bool triaxial = false;
  for (int i = 0; i < n; i++) {
    const double *s = atom->shape[i];
    const SymmetryAxis axis = symmetry_axis(s);
    Grain &grain = grains_[i];
    grain.spheroid = make_spheroid(s, atom->quaternion[i]);
    grain.equivalent_radius = std::cbrt(0.75 * atom->volume[i] / M_PI);  // in the host's words, to the last bit
    grain.elongation = *std::max_element(s, s + 3) - *std::min_element(s, s + 3);
    grain.axis = std::max(axis.index, 0);
    grain.triaxial = axis.shape == Shape::triaxial;
    triaxial = triaxial || grain.triaxial;
  }
  frames_.resize(triaxial ? n : 0);
}

/** The host takes a blockiness within 0.01 of 2 for an ellipsoid's; so do we. */
void EllipsoidBodies::refuse_other_blockiness() {
  const int none = std::numeric_limits<int>::max();
  struct { int tag, rank; } mine{none, comm->me}, first;
  int found = -1;
  for (int i = 0; i < atom->nlocal; i++) {
    const double *b = atom->blockiness[i];
    if (std::fabs(b[0] - 2.0) < 1e-2 && std::fabs(b[1] - 2.0) < 1e-2) continue;
    if (atom->tag[i] >= mine.tag) continue;
    mine.tag = atom->tag[i];
    found = i;
  }
  MPI_Allreduce(&mine, &first, 1, MPI_2INT, MPI_MINLOC, world);
  if (first.tag == none) return;
  double blockiness[2] = {0.0, 0.0};
  if (first.rank == comm->me) std::copy(atom->blockiness[found], atom->blockiness[found] + 2, blockiness);
  MPI_Bcast(blockiness, 2, MPI_DOUBLE, first.rank, world);
  char message[200];
  snprintf(message, sizeof message, "surface ellipsoid needs blockiness 2 2 of every grain, got %g %g of grain %d: use surface superquadric",
           blockiness[0], blockiness[1], first.tag);
  error->all(FLERR, message);
}

EllipsoidContact EllipsoidBodies::contact(int i, int j, const double d[3], double start) {
  const EllipsoidContact c = grains_[i].triaxial || grains_[j].triaxial ? ellipsoid_contact(frames_[i], frames_[j], d, start)
                                                                        : ellipsoid_contact(grains_[i].spheroid, grains_[j].spheroid, d, start);
  counts.solved++;
  counts.steps += c.steps;
  counts.touching += c.touching;
  counts.most_steps = std::max<double>(counts.most_steps, c.steps);
  if (c.fallback) {
    counts.fallbacks++;
    if (!warned_) {
      warned_ = true;
      char message[200];
      snprintf(message, sizeof message, "surface ellipsoid: no regular contact of grains %d and %d (concentric?): their normal is arbitrary "
               "(told once; compute contact/solver counts)", atom->tag[i], atom->tag[j]);
      error->warning(FLERR, message);
    }
  }
  return c;
}

double EllipsoidBodies::curvature(int i, const double y[3], bool mean) const {
  const Grain &grain = grains_[i];
  if (mean) return grain.triaxial ? mean_curvature(frames_[i], y) : mean_curvature(grain.spheroid, y);
  return std::sqrt(grain.triaxial ? gaussian_curvature(frames_[i], y) : gaussian_curvature(grain.spheroid, y));
}

}

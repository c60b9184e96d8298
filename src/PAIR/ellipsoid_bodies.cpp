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
  if (only_spheres_) return;
  for (int i = 0; i < n; i++)
    if (!is_sphere(i)) rotated_axis(atom->quaternion[i], grains_[i].axis, grains_[i].spheroid.u);
  if (frames_.empty()) return;
  for (int i = 0; i < n; i++) frames_[i] = make_triaxial(atom->shape[i], atom->quaternion[i]);
}

void EllipsoidBodies::read_shapes(int n) {
  grains_.resize(n);
  bool triaxial = false;
  only_spheres_ = true;
  for (int i = 0; i < n; i++) {
    const double *s = atom->shape[i];
    const SymmetryAxis axis = symmetry_axis(s);
    Grain &grain = grains_[i];
    grain.spheroid = make_spheroid(s, atom->quaternion[i]);
    grain.equivalent_radius = std::cbrt(0.75 * atom->volume[i] / M_PI);  // in the host's words, to the last bit
    grain.elongation = axis.shape == Shape::sphere ? 0.0 : *std::max_element(s, s + 3) - *std::min_element(s, s + 3);
    grain.across = std::sqrt(grain.spheroid.equatorial);
    grain.axis = std::max(axis.index, 0);
    grain.triaxial = axis.shape == Shape::triaxial;
    triaxial = triaxial || grain.triaxial;
    only_spheres_ = only_spheres_ && axis.shape == Shape::sphere;
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

void EllipsoidBodies::solve(int n, const Query *queries, EllipsoidContact *contacts) {
  if (frames_.empty()) {
    pairs_.resize(n);
    for (int k = 0; k < n; k++) {
      const Query &q = queries[k];
      pairs_[k] = {&grains_[q.i].spheroid, &grains_[q.j].spheroid, {q.d[0], q.d[1], q.d[2]}, q.start};
    }
    ellipsoid_contacts(n, pairs_.data(), contacts);
  } else {
    for (int k = 0; k < n; k++) {
      const Query &q = queries[k];
      const Grain &one = grains_[q.i], &two = grains_[q.j];
      contacts[k] = one.triaxial || two.triaxial ? ellipsoid_contact(frames_[q.i], frames_[q.j], q.d, q.start)
                                                 : ellipsoid_contact(one.spheroid, two.spheroid, q.d, q.start);
    }
  }
  for (int k = 0; k < n; k++) count(queries[k], contacts[k]);
}

void EllipsoidBodies::count(const Query &query, const EllipsoidContact &contact) {
  counts.solved++;
  counts.steps += contact.steps;
  counts.touching += contact.touching;
  counts.most_steps = std::max<double>(counts.most_steps, contact.steps);
  if (!contact.fallback) return;
  counts.fallbacks++;
  if (warned_) return;
  warned_ = true;
  char message[200];
  snprintf(message, sizeof message, "surface ellipsoid: no regular contact of grains %d and %d (concentric?), their normal is arbitrary "
           "(told once; compute contact/solver counts)", atom->tag[query.i], atom->tag[query.j]);
  error->warning(FLERR, message);
}

double EllipsoidBodies::mean_curvature(int i, const double y[3]) const {
  return grains_[i].triaxial ? grainscope::mean_curvature(frames_[i], y) : grainscope::mean_curvature(grains_[i].spheroid, y);
}

}

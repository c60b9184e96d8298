// SPDX-License-Identifier: GPL-2.0-or-later
#include "ellipsoid_bodies.h"
#include "fitted.h"
#include "symmetry_axis.h"
#include "atom.h"
#include "comm.h"
#include "error.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace grainscope {

void EllipsoidBodies::prepare() {
  const int n = atom->nlocal + atom->nghost;
  if (lists_.renewed(*neighbor, *update)) {
    refuse_other_blockiness();
    read_shapes(n);
    refuse_other_than_spheres();
  }
  fit(turned_, keeps_turned_ ? n : 0);
  for (std::size_t i = 0; i < turned_.size(); i++) turned_[i] = turned(i);
}

EllipsoidBodies::Shape EllipsoidBodies::shape_of(int i) const {
  const double *s = atom->shape[i];
  const SymmetryAxis axis = symmetry_axis(s);
  Shape shape;
  shape.spheroid = make_spheroid(s, atom->quaternion[i]);
  shape.equivalent_radius = std::cbrt(0.75 * atom->volume[i] / M_PI);  // in the host's words, to the last bit
  shape.elongation =
      axis.shape == grainscope::Shape::sphere ? 0.0 : *std::max_element(s, s + 3) - *std::min_element(s, s + 3);
  shape.axis = std::max(axis.index, 0);
  shape.triaxial = axis.shape == grainscope::Shape::triaxial;
  return shape;
}

void EllipsoidBodies::read_shapes(int n) {
  int alike = n ? 1 : 0;
  while (alike < n && std::equal(atom->shape[alike], atom->shape[alike] + 3, atom->shape[0]) &&
         atom->volume[alike] == atom->volume[0])
    alike++;
  one_shape_ = n && alike == n;
  fit(shapes_, one_shape_ ? 1 : n);
  some_triaxial_ = some_spheres_ = false;
  only_spheres_ = true;
  for (std::size_t i = 0; i < shapes_.size(); i++) {
    shapes_[i] = shape_of(i);
    const bool sphere = is_sphere(i);
    some_triaxial_ = some_triaxial_ || shapes_[i].triaxial;
    some_spheres_ = some_spheres_ || sphere;
    only_spheres_ = only_spheres_ && sphere;
  }
}

/** LIGGGHTS treats a blockiness within 0.01 of 2 as that of an ellipsoid; so do we. */
void EllipsoidBodies::refuse_other_blockiness() {
  const int none = std::numeric_limits<int>::max();
  struct {
    int tag, rank;
  } mine{none, comm->me}, first;
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
  snprintf(message, sizeof message,
           "surface ellipsoid: every grain must have blockiness 2 2, got %g %g of grain %d: use surface superquadric",
           blockiness[0], blockiness[1], first.tag);
  error->all(FLERR, message);
}

void EllipsoidBodies::refuse_other_than_spheres() {
  if (sphere_model_.empty()) return;
  const int none = std::numeric_limits<int>::max();
  int first = none;
  for (int i = 0; i < atom->nlocal; i++)
    if (!is_sphere(i)) first = std::min(first, atom->tag[i]);
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, world);
  if (first == none) return;
  const std::string message =
      "surface ellipsoid: '" + sphere_model_ + "' works with spheres only, and grain " + std::to_string(first) +
      " is not a sphere: use spheres, or cohesion sjkr or sjkr2, for which surface ellipsoid gives the contact area";
  error->all(FLERR, message.c_str());
}

Triaxial EllipsoidBodies::frame(int i) const { return make_triaxial(atom->shape[i], atom->quaternion[i]); }

Spheroid EllipsoidBodies::turned(int i) const {
  Spheroid body = spheroid(i);
  if (one_shape_ || !is_sphere(i)) rotated_axis(atom->quaternion[i], symmetry(i), body.u);
  return body;
}

EllipsoidContact EllipsoidBodies::solve_alone(const Query &q) const {
  if (is_triaxial(q.i) || is_triaxial(q.j)) return ellipsoid_contact(frame(q.i), frame(q.j), q.d, q.start);
  if (!keeps_turned_) return ellipsoid_contact(turned(q.i), turned(q.j), q.d, q.start);
  return ellipsoid_contact(turned_[q.i], turned_[q.j], q.d, q.start);
}

EllipsoidContact EllipsoidBodies::solve(const Query &query) {
  EllipsoidContact contact = solve_alone(query);
  count(query, contact);
  return contact;
}

void EllipsoidBodies::count(const Query &query, EllipsoidContact &contact) {
  count(contact.touching, contact.steps);
  if (!contact.fallback) return;
  counts.fallbacks++;
  const double r = equivalent_radius(query.i), *d = query.d;
  if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < 1e-20 * r * r && atom->tag[query.i] > atom->tag[query.j]) {
    // Concentric: both owners must choose the same normal, so the one that sees the pair the other way round reverses
    // it.
    const EllipsoidContact turned = solve_alone({query.j, query.i, {-d[0], -d[1], -d[2]}, 0.0});
    for (int k = 0; k < 3; k++) {
      contact.normal[k] = -turned.normal[k];
      contact.point[k] = turned.point[k];
    }
    for (int k = 0; k < 2; k++) {
      contact.depth[k] = turned.depth[1 - k];
      contact.curvature[k] = turned.curvature[1 - k];
    }
    contact.lambda = 1.0 - turned.lambda;
  }
  if (warned_) return;
  warned_ = true;
  char message[200];
  snprintf(message, sizeof message,
           "surface ellipsoid: grains %d and %d have no regular contact (concentric?), so their normal is arbitrary "
           "(reported once per rank; counted by compute contact/solver)",
           atom->tag[query.i], atom->tag[query.j]);
  error->warning(FLERR, message);
}

void EllipsoidBodies::count(bool touching, double steps) {
  counts.solved++;
  counts.touching += touching;
  counts.steps += steps;
  counts.most_steps = std::max(counts.most_steps, steps);
}

void EllipsoidBodies::count(const SolverTally &tally) {
  for (int k = 0; k < LANES; k++) {
    counts.solved -= tally.solved[k];
    counts.touching -= tally.touching[k];
    counts.steps += tally.steps[k];
    counts.most_steps = std::max(counts.most_steps, tally.most_steps[k]);
  }
}

double EllipsoidBodies::mean_curvature(int i, const double y[3]) const {
  return is_triaxial(i) ? grainscope::mean_curvature(frame(i), y) : grainscope::mean_curvature(turned(i), y);
}

}

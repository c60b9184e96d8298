// SPDX-License-Identifier: GPL-2.0-or-later
// The source of LIGGGHTS itself, under other names than those of the mended copies.
#define Superquadric UnmendedSuperquadric
#define MathExtraLiggghtsNonspherical UnmendedNonspherical
#include LIGGGHTS_SUPERQUADRIC
#include LIGGGHTS_NONSPHERICAL
#include LIGGGHTS_SUPERQUADRIC_CONTACT
#include "plain_superquadric.h"

struct PlainSuperquadric::Routines {
  double blockiness[2] = {2.0, 2.0};
  UnmendedSuperquadric grain;
};

PlainSuperquadric::PlainSuperquadric(double *centre, double *quaternion, double *semi_axes) : routines_(new Routines) {
  routines_->grain.set(centre, quaternion, semi_axes, routines_->blockiness);
}

PlainSuperquadric::~PlainSuperquadric() {}

double PlainSuperquadric::value(const double *point) { return routines_->grain.shape_function_global(point); }

bool PlainSuperquadric::plane(const double *normal, const double *point, double *deepest, double *lowest) {
  return routines_->grain.plane_intersection(normal, point, deepest, lowest);
}

double PlainSuperquadric::line(const double *a, const double *b, double *closest) {
  return routines_->grain.line_intersection(a, b, closest);
}

bool PlainSuperquadric::edge(const double *a, const double *b) { return routines_->grain.edge_intersection(a, b); }

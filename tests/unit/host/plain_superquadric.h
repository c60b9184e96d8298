// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PLAIN_SUPERQUADRIC_H
#define GRAINSCOPE_PLAIN_SUPERQUADRIC_H

#include <memory>

/** A grain of blockiness 2 2 by LIGGGHTS's routines as they are, without mends. */
class PlainSuperquadric {
 public:
  PlainSuperquadric(double *centre, double *quaternion, double *semi_axes);
  ~PlainSuperquadric();
  double value(const double *point);  // of the shape function
  bool plane(const double *normal, const double *point, double *deepest, double *lowest);
  double line(const double *a, const double *b, double *closest);
  bool edge(const double *a, const double *b);

 private:
  struct Routines;
  std::unique_ptr<Routines> routines_;
};

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#include "symmetry_axis.h"
#include <gtest/gtest.h>

using grainscope::Shape;
using grainscope::symmetry_axis;

namespace {

void expect(double a, double b, double c, Shape shape, int index) {
  const double semi_axes[3] = {a, b, c};
  const grainscope::SymmetryAxis axis = symmetry_axis(semi_axes);
  EXPECT_EQ(axis.shape, shape) << a << " " << b << " " << c;
  EXPECT_EQ(axis.index, index) << a << " " << b << " " << c;
}

}

TEST(symmetry_axis, of_every_kind_of_grain) {
  expect(1, 1, 1, Shape::sphere, -1);
  expect(1, 1, 2, Shape::prolate, 2);
  expect(1, 1, 0.5, Shape::oblate, 2);
  expect(2, 1, 1, Shape::prolate, 0);
  expect(1, 0.5, 1, Shape::oblate, 1);
  expect(1, 3, 2, Shape::triaxial, 1);
}

TEST(symmetry_axis, forgives_round_off) {
  expect(1, 1 + 1e-12, 1.5, Shape::prolate, 2);
  expect(1e-3, 1e-3 * (1 + 1e-12), 1e-3, Shape::sphere, -1);
  expect(1, 1.001, 1.5, Shape::triaxial, 2);
}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "superquadric_volume.h"
#include <gtest/gtest.h>

using grainscope::superquadric_volume;

TEST(superquadric_volume, ellipsoid) {
  EXPECT_DOUBLE_EQ(superquadric_volume(1.0, 2.0, 3.0, 2.0, 2.0), 8.0 * M_PI);
  EXPECT_NEAR(superquadric_volume(1.0, 2.0, 3.0, 2.0 + 1e-12, 2.0), 8.0 * M_PI, 1e-9);  // the beta functions
}

TEST(superquadric_volume, bodies_known_by_hand) {
  EXPECT_NEAR(superquadric_volume(1.0, 1.0, 1.0, 1.0, 1.0), 4.0 / 3.0, 1e-13);  // an octahedron, |x| + |y| + |z| = 1
  EXPECT_NEAR(superquadric_volume(1.0, 1.0, 2.0, 1.0, 2.0), 4.0 / 3.0 * M_PI, 1e-12);  // two cones of height 2
  EXPECT_NEAR(superquadric_volume(1.0, 1.5, 2.0, 1e7, 2.0), 6.0 * M_PI, 1e-5);         // a cylinder
  EXPECT_NEAR(superquadric_volume(1.0, 1.5, 2.0, 1e7, 1e7), 24.0, 1e-4);               // a box
}

/** The mean over z of its cross sections, which are superellipses: sum by the midpoint rule. */
TEST(superquadric_volume, adds_up_from_cross_sections) {
  const double n1 = 3.0, n2 = 5.0, a = 1.0, b = 1.2, c = 0.7;
  const int steps = 2000;
  double area = 0.0, volume = 0.0;
  for (int k = 0; k < steps; k++) {  // x = s^2 on the end, where the edge is steep
    const double t = (k + 0.5) / steps, x = 1.0 - t * t;
    area += 4.0 * a * b * std::pow(1.0 - std::pow(x, n2), 1.0 / n2) * 2.0 * t / steps;
    volume += 2.0 * c * std::pow(1.0 - std::pow(x, n1), 2.0 / n1) * 2.0 * t / steps;
  }
  EXPECT_NEAR(superquadric_volume(a, b, c, n1, n2), area * volume, 2e-6);
}

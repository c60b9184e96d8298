// SPDX-License-Identifier: GPL-2.0-or-later
#include "ellipsoid_bands.h"
#include <gtest/gtest.h>
#include <cmath>
#include <numeric>

using namespace grainscope;
using Eigen::Vector3d;

namespace {

/** Area of a spheroid a, a, c between the equator and the parametric angle t from the pole, both hemispheres: closed
 *  form. */
double closed_form_beyond(double a, double c, double t) {
  const double z = c * std::cos(t), k = (a * a - c * c) / (c * c * c * c);  // of sqrt(1 + k z^2), times a
  const double one = 1.0 + k * z * z;
  if (std::fabs(k) < 1e-14) return 4.0 * M_PI * a * z;
  const double part =
      k > 0.0 ? std::asinh(std::sqrt(k) * z) / std::sqrt(k) : std::asin(std::sqrt(-k) * z) / std::sqrt(-k);
  return 2.0 * M_PI * a * (z * std::sqrt(one) + part);
}

double sum(const std::vector<double> &values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}

TEST(ellipsoid_bands, add_up_to_the_spheroids_area) {
  for (double alpha : {0.01, 0.33, 0.67, 1.0, 1.5, 3.0, 100.0})
    for (SurfaceAngle angle : {SurfaceAngle::polar, SurfaceAngle::parametric})
      for (int bands : {1, 10, 37}) {
        const double whole = closed_form_beyond(1.0, alpha, 0.0);
        EXPECT_NEAR(sum(band_areas(Vector3d(1.0, 1.0, alpha), bands, angle)), whole, 1e-12 * whole) << alpha;
      }
}

TEST(ellipsoid_bands, each_is_the_closed_form) {
  const int bands = 10;
  for (double alpha : {0.33, 0.67, 1.5, 3.0})
    for (SurfaceAngle angle : {SurfaceAngle::polar, SurfaceAngle::parametric}) {
      const auto areas = band_areas(Vector3d(0.7, 0.7, 0.7 * alpha), bands, angle);
      const auto parametric = [&](double psi) {
        return angle == SurfaceAngle::polar ? std::atan2(alpha * std::sin(psi), std::cos(psi)) : psi;
      };
      for (int k = 0; k < bands; k++) {
        const double from = parametric(k * M_PI_2 / bands), to = parametric((k + 1) * M_PI_2 / bands);
        const double exact = closed_form_beyond(0.7, 0.7 * alpha, from) - closed_form_beyond(0.7, 0.7 * alpha, to);
        EXPECT_NEAR(areas[k], exact, 1e-12 * closed_form_beyond(0.7, 0.7 * alpha, 0.0)) << alpha << ' ' << k;
      }
    }
}

TEST(ellipsoid_bands, of_a_triaxial_grain_do_not_depend_on_the_axis) {
  const Vector3d s(0.5, 1.0, 1.7);
  const double area = sum(band_areas(s, 4, SurfaceAngle::parametric));
  for (const Vector3d &turned : {Vector3d(1.0, 1.7, 0.5), Vector3d(1.7, 0.5, 1.0)})
    for (SurfaceAngle angle : {SurfaceAngle::polar, SurfaceAngle::parametric})
      EXPECT_NEAR(sum(band_areas(turned, 5, angle)), area, 1e-12 * area);
}

TEST(ellipsoid_bands, sphere_gives_zones_of_equal_height) {
  const auto areas = band_areas(Vector3d::Constant(2.0), 3, SurfaceAngle::polar);
  for (int k = 0; k < 3; k++)
    EXPECT_NEAR(areas[k], 16.0 * M_PI * (std::cos(k * M_PI / 6) - std::cos((k + 1) * M_PI / 6)), 1e-12);
}

TEST(ellipsoid_bands, angles_of_known_points) {
  const Vector3d s(1.0, 1.0, 2.0);
  EXPECT_DOUBLE_EQ(surface_angle({0.0, 0.0, -2.0}, s, SurfaceAngle::polar), 0.0);
  EXPECT_DOUBLE_EQ(surface_angle({0.0, -1.0, 0.0}, s, SurfaceAngle::polar), M_PI_2);
  const double t = 0.3;
  const Vector3d point(std::sin(t), 0.0, 2.0 * std::cos(t));
  EXPECT_NEAR(surface_angle(point, s, SurfaceAngle::parametric), t, 1e-15);
  EXPECT_NEAR(surface_angle(0.9 * point, s, SurfaceAngle::parametric), t, 1e-15);  // inside the grain likewise
  EXPECT_NEAR(surface_angle(point, s, SurfaceAngle::polar), std::atan2(std::sin(t), 2.0 * std::cos(t)), 1e-15);
}

TEST(ellipsoid_bands, equator_belongs_to_the_last_band) {
  EXPECT_EQ(band_of(0.0, 10), 0);
  EXPECT_EQ(band_of(M_PI_2, 10), 9);
  EXPECT_EQ(band_of(0.5 * M_PI_2 * (1.0 - 1e-15), 10), 4);
}

TEST(ellipsoid_bands, long_and_flat_triaxial_grains_have_one_area) {
  for (const Vector3d &semi : {Vector3d(0.02, 10, 1), Vector3d(50, 0.1, 1), Vector3d(10, 0.1, 1), Vector3d(0.3, 10, 1),
                               Vector3d(0.02, 0.1, 1)}) {
    const double area = sum(band_areas(semi, 1, SurfaceAngle::parametric));
    for (int bands : {1, 3, 10})
      EXPECT_NEAR(sum(band_areas(semi, bands, SurfaceAngle::polar)) / area, 1.0, 5e-12) << semi.transpose();
  }
}

TEST(ellipsoid_bands, what_is_no_number_is_in_no_band) { EXPECT_EQ(band_of(std::nan(""), 10), -1); }

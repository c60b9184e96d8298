// SPDX-License-Identifier: GPL-2.0-or-later
#include "ellipsoid_bands.h"
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <algorithm>
#include <cmath>

namespace grainscope {

using Eigen::Vector3d;

namespace {

/** Area per dpsi dphi at the direction (psi, phi) as seen from the centre: |A u| / (u A u)^2 sin psi, A = diag(1/a^2, 1/b^2, 1/c^2). */
double polar_element(const Vector3d &s, double psi, double phi) {
  const Vector3d u(std::sin(psi) * std::cos(phi), std::sin(psi) * std::sin(phi), std::cos(psi));
  const Vector3d au = u.cwiseQuotient(s.cwiseAbs2());
  const double uau = u.dot(au);
  return au.norm() / (uau * uau) * std::sin(psi);
}

/** Area per dpsi dphi at the point (a sin psi cos phi, b sin psi sin phi, c cos psi). */
double parametric_element(const Vector3d &s, double psi, double phi) {
  const double sine = std::sin(psi);
  return sine * Vector3d(s[1] * s[2] * sine * std::cos(phi), s[0] * s[2] * sine * std::sin(phi), s[0] * s[1] * std::cos(psi)).norm();
}

template <class F>
double integral(F f, double from, double to) {
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, from, to, 4, 1e-13);
}

}

double surface_angle(const Vector3d &x, const Vector3d &semi_axes, SurfaceAngle angle) {
  const Vector3d y = angle == SurfaceAngle::polar ? x : Vector3d(x.cwiseQuotient(semi_axes));
  return std::atan2(y.head<2>().norm(), std::fabs(y[2]));
}

int band_of(double psi, int bands) { return std::min(static_cast<int>(psi / M_PI_2 * bands), bands - 1); }

std::vector<double> band_areas(const Vector3d &semi_axes, int bands, SurfaceAngle angle) {
  const bool round = semi_axes[0] == semi_axes[1];
  const bool polar = angle == SurfaceAngle::polar;
  // On a spheroid a polar angle is one parametric angle, whose area element is the smoother one.
  const auto element = polar && !round ? polar_element : parametric_element;
  const auto edge = [&](int k) {
    const double psi = k * M_PI_2 / bands;
    return polar && round ? std::atan2(semi_axes[2] / semi_axes[0] * std::sin(psi), std::cos(psi)) : psi;
  };
  const auto ring = [&](double psi) {
    if (round) return M_PI_2 * element(semi_axes, psi, 0.0);
    return integral([&](double phi) { return element(semi_axes, psi, phi); }, 0.0, M_PI_2);
  };
  std::vector<double> areas(bands);
  for (int k = 0; k < bands; k++) areas[k] = 8.0 * integral(ring, edge(k), edge(k + 1));  // eight octants
  return areas;
}

}

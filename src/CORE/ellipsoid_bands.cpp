// SPDX-License-Identifier: GPL-2.0-or-later
#include "ellipsoid_bands.h"
#include "bin_index.h"
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <algorithm>
#include <cmath>

namespace grainscope {

using Eigen::Vector3d;

namespace {

/** Area per dpsi dphi at the direction (psi, phi) as seen from the centre: |A u| / (u A u)^2 sin psi, A = diag(1/a^2,
 *  1/b^2, 1/c^2). */
double polar_element(const Vector3d &s, double psi, double phi) {
  const Vector3d u(std::sin(psi) * std::cos(phi), std::sin(psi) * std::sin(phi), std::cos(psi));
  const Vector3d au = u.cwiseQuotient(s.cwiseAbs2());
  const double uau = u.dot(au);
  return au.norm() / (uau * uau) * std::sin(psi);
}

/** Area per dpsi dphi at the point (a sin psi cos phi, b sin psi sin phi, c cos psi). */
double parametric_element(const Vector3d &s, double psi, double phi) {
  const double sine = std::sin(psi);
  return sine *
         Vector3d(s[1] * s[2] * sine * std::cos(phi), s[0] * s[2] * sine * std::sin(phi), s[0] * s[1] * std::cos(psi))
             .norm();
}

/** The angle of the point (x cos t, y sin t), and its derivative by t. */
struct Stretched {
  double angle, slope;
  Stretched(double t, double y, double x) : angle(std::atan2(y * std::sin(t), x * std::cos(t))) {
    const double along = x * std::cos(t), up = y * std::sin(t);
    slope = x * y / (along * along + up * up);
  }
};

template <class F>
double integral(F f, double from, double to) {
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, from, to, 4, 1e-13);
}

}

double surface_angle(const Vector3d &x, const Vector3d &semi_axes, SurfaceAngle angle) {
  const Vector3d y = angle == SurfaceAngle::polar ? x : Vector3d(x.cwiseQuotient(semi_axes));
  return std::atan2(y.head<2>().norm(), std::fabs(y[2]));
}

int band_of(double psi, int bands) { return nearest_bin_index(psi / M_PI_2 * bands, bands); }

std::vector<double> band_areas(const Vector3d &semi_axes, int bands, SurfaceAngle angle) {
  const bool round = semi_axes[0] == semi_axes[1];
  const bool polar = angle == SurfaceAngle::polar;
  const double across = round ? semi_axes[0] : std::sqrt(semi_axes[0] * semi_axes[1]), flatness = semi_axes[2] / across;
  // Polar angles are reached through parametric ones, in which elements change slowly however long or flat the grain
  // is.
  const auto edge = [&](int k) {
    const double psi = k * M_PI_2 / bands;
    return polar ? std::atan2(flatness * std::sin(psi), std::cos(psi)) : psi;
  };
  const auto ring = [&](double tau) {
    if (round) return M_PI_2 * parametric_element(semi_axes, tau, 0.0);
    if (!polar) return integral([&](double phi) { return parametric_element(semi_axes, tau, phi); }, 0.0, M_PI_2);
    const Stretched psi(tau, across, semi_axes[2]);
    return psi.slope * integral(
                           [&](double t) {
                             const Stretched phi(t, semi_axes[1], semi_axes[0]);
                             return phi.slope * polar_element(semi_axes, psi.angle, phi.angle);
                           },
                           0.0, M_PI_2);
  };
  std::vector<double> areas(bands);
  for (int k = 0; k < bands; k++) areas[k] = 8.0 * integral(ring, edge(k), edge(k + 1));  // eight octants
  return areas;
}

}

// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SUPERQUADRIC_VOLUME_H
#define GRAINSCOPE_SUPERQUADRIC_VOLUME_H

#include <cmath>

namespace grainscope {

/** Volume of the superquadric (|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1 = 1:
 *  2 a b c e1 e2 B(e1/2 + 1, e1) B(e2/2, e2/2), e = 2/n, B Euler's beta function; 4 pi/3 a b c for n1 = n2 = 2.
 *  Source: Jaklic, Leonardis & Solina 2000, Segmentation and Recovery of Superquadrics, ch. 2. */
inline double superquadric_volume(double a, double b, double c, double n1, double n2) {
  const double box = a * b * c;
  if (n1 == 2.0 && n2 == 2.0) return 4.0 / 3.0 * M_PI * box;
  const double e1 = 2.0 / n1, e2 = 2.0 / n2;
  const auto beta = [](double x, double y) { return std::exp(std::lgamma(x) + std::lgamma(y) - std::lgamma(x + y)); };
  return 2.0 * box * e1 * e2 * beta(0.5 * e1 + 1.0, e1) * beta(0.5 * e2, 0.5 * e2);
}

}

#endif

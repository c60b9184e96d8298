// SPDX-License-Identifier: GPL-2.0-or-later
#include "momentum_flux.h"
#include <gtest/gtest.h>
#include <random>
#include <vector>

using namespace grainscope;
using Eigen::Vector3d;

/** Of any number of grains: fours, and what is left. */
TEST(momentum_flux, is_the_sum_over_grains) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  AffineFlow flow;
  flow.velocity_gradient << 0.1, 0.7, -0.3, 0, 0.2, 0.4, 0, 0, -0.5;
  flow.centre = Vector3d(0.3, -0.2, 0.5);
  for (int n = 0; n <= 13; n++) {
    std::vector<double> x(3 * n), v(3 * n), mass(n);
    for (std::vector<double> *numbers : {&x, &v, &mass})
      for (double &one : *numbers) one = uniform(engine);
    const MovingGrains grains{n, x.data(), v.data(), mass.data()};
    const auto u = [&](int i) {
      return Vector3d(Eigen::Map<const Vector3d>(&v[3 * i]) - flow.flow(Eigen::Map<const Vector3d>(&x[3 * i])));
    };
    Vector3d momentum = Vector3d::Zero();
    double all = 0.0;
    for (int i = 0; i < n; i++) {
      momentum += mass[i] * u(i);
      all += mass[i];
    }
    const std::array<double, 4> found = momentum_of(grains, flow);
    for (int k = 0; k < 3; k++) EXPECT_NEAR(found[k], momentum[k], 1e-14);
    EXPECT_NEAR(found[3], all, 1e-14);

    const Vector3d mean(0.1, 0.4, -0.2);
    Eigen::Matrix3d flux = Eigen::Matrix3d::Zero();
    for (int i = 0; i < n; i++) flux += mass[i] * (u(i) - mean) * (u(i) - mean).transpose();
    EXPECT_LT((symmetric_tensor(momentum_flux_of(grains, flow, mean).data()) - flux).norm(), 1e-13);
  }
}

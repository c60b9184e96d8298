// SPDX-License-Identifier: GPL-2.0-or-later
#include "outside_cell.h"
#include <gtest/gtest.h>
#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <random>
#include <vector>

using grainscope::CellFrame;
using grainscope::next_outside;

namespace {

const double NOTHING = std::numeric_limits<double>::quiet_NaN();

/** Against the whole parts of s = H^-1 (x - centre), by Eigen. */
struct Cell {
  Eigen::Matrix3d edges;
  Eigen::Vector3d centre{0.3, -2.0, 1.0};
  CellFrame frame;

  Cell() {
    edges << 4.0, 1.1, -0.4, 0.0, 3.0, 0.7, 0.0, 0.0, 5.0;
    const Eigen::Matrix3d inverse = edges.inverse();
    for (int k = 0; k < 3; k++) {
      frame.centre[k] = centre[k];
      for (int l = 0; l < 3; l++) frame.inverse[k][l] = inverse(k, l);
    }
  }
  Eigen::Vector3d at(const Eigen::Vector3d &s) const { return centre + edges * s; }
};

}

TEST(outside_cell, finds_each_place_that_is_not_inside) {
  const Cell cell;
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> inside(-0.4999, 0.4999), chance(0.0, 1.0);
  for (int n : {0, 1, 3, 4, 5, 8, 23, 100})
    for (double share : {0.0, 0.1, 0.5, 1.0}) {
      std::vector<double> places(3 * n);
      std::vector<int> expected, found;
      for (int i = 0; i < n; i++) {
        Eigen::Vector3d s(inside(engine), inside(engine), inside(engine));
        if (chance(engine) < share) {
          s[i % 3] = (i % 2 ? -1 : 1) * (0.5001 + inside(engine) * 0.0001 + (i % 5 == 0 ? 7.0 : 0.0));
          expected.push_back(i);
        }
        const Eigen::Vector3d x = cell.at(s);
        std::copy_n(x.data(), 3, &places[3 * i]);
      }
      for (int i = next_outside(cell.frame, places.data(), 0, n); i < n;
           i = next_outside(cell.frame, places.data(), i + 1, n))
        found.push_back(i);
      EXPECT_EQ(found, expected) << n << " places, " << share << " of them outside";
    }
}

TEST(outside_cell, what_is_no_number_is_outside) {
  const Cell cell;
  for (int bad = 0; bad < 15; bad++) {
    std::vector<double> places;
    for (int i = 0; i < 5; i++) places.insert(places.end(), cell.centre.data(), cell.centre.data() + 3);
    EXPECT_EQ(next_outside(cell.frame, places.data(), 0, 5), 5);
    places[bad] = NOTHING;
    // z is in all three components of s, y in two
    EXPECT_EQ(next_outside(cell.frame, places.data(), 0, 5), bad / 3);
  }
}

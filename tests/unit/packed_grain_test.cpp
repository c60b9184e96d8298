// SPDX-License-Identifier: GPL-2.0-or-later
#include "packed_grain.h"
#include "ellipsoid_contact.h"
#include <gtest/gtest.h>
#include <algorithm>
#include <random>
#include <vector>

using namespace grainscope;

namespace {

/** Grains as others keep them, in arrays that end with the last of them. */
struct Columns {
  std::vector<double> x, velocity, spin, quaternion, radius, mass, size;

  explicit Columns(int count) {
    std::mt19937_64 engine(count);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (auto *rows : {&x, &velocity, &spin})
      for (int k = 0; k < 3 * count; k++) rows->push_back(uniform(engine));
    for (int k = 0; k < 4 * count; k++) quaternion.push_back(uniform(engine));
    for (auto *numbers : {&radius, &mass, &size})
      for (int k = 0; k < count; k++) numbers->push_back(uniform(engine));
  }

  GrainRows rows(bool sizes) const {
    return {static_cast<int>(radius.size()),
            x.data(),
            velocity.data(),
            spin.data(),
            quaternion.data(),
            radius.data(),
            mass.data(),
            sizes ? size.data() : nullptr};
  }
};

/** One more than there are, which stays as it is. */
std::vector<PackedGrain> untouched(int count) {
  std::vector<PackedGrain> grains(count + 1);
  for (int i = 0; i <= count; i++) {
    PackedGrain &grain = grains[i];
    for (double *row : {grain.x, grain.velocity, grain.spin, grain.axis}) std::fill_n(row, 3, 1000.0 + i);
    grain.reach = grain.mass = grain.size = grain.inverse_product = 2000.0 + i;
  }
  return grains;
}

void expect_row(const double *found, const double *expected) {
  for (int k = 0; k < 3; k++) EXPECT_EQ(found[k], expected[k]);
}

void expect_untouched(const PackedGrain &grain, int i) {
  const PackedGrain before = untouched(i)[i];
  expect_row(grain.x, before.x);
  expect_row(grain.velocity, before.velocity);
  expect_row(grain.spin, before.spin);
  expect_row(grain.axis, before.axis);
  EXPECT_EQ(grain.reach, before.reach);
  EXPECT_EQ(grain.mass, before.mass);
  EXPECT_EQ(grain.size, before.size);
  EXPECT_EQ(grain.inverse_product, before.inverse_product);
}

void expect_axis(const Columns &columns, int i, unsigned char symmetry, const PackedGrain &grain) {
  double axis[3];
  const PackedGrain before = untouched(i)[i];
  const double *quaternion = &columns.quaternion[4 * i];
  if (symmetry < KEPT) rotated_axis(quaternion, symmetry, axis);
  else std::copy_n(symmetry == KEPT ? before.axis : quaternion, 3, axis);
  expect_row(grain.axis, axis);
  EXPECT_EQ(grain.inverse_product, symmetry == QUATERNION ? quaternion[3] : before.inverse_product);
  EXPECT_EQ(grain.size, before.size);
  expect_row(grain.x, before.x);
}

}

TEST(packed_grain, holds_the_motion_of_every_grain) {
  for (int count = 0; count < 10; count++)
    for (bool sizes : {false, true}) {
      const Columns columns(count);
      std::vector<PackedGrain> grains = untouched(count);
      pack_motion(columns.rows(sizes), grains.data());
      for (int i = 0; i < count; i++) {
        const PackedGrain &grain = grains[i];
        expect_row(grain.x, &columns.x[3 * i]);
        expect_row(grain.velocity, &columns.velocity[3 * i]);
        expect_row(grain.spin, &columns.spin[3 * i]);
        EXPECT_EQ(grain.reach, columns.radius[i]);
        EXPECT_EQ(grain.mass, columns.mass[i]);
        EXPECT_EQ(grain.size, sizes ? columns.size[i] : 2000.0 + i);
        expect_row(grain.axis, untouched(i)[i].axis);
        EXPECT_EQ(grain.inverse_product, 2000.0 + i);
      }
      expect_untouched(grains[count], count);
    }
}

TEST(packed_grain, holds_the_axis_of_every_spheroid) {
  for (int count = 0; count < 10; count++) {
    const Columns columns(count);
    for (unsigned char alike : {0, 1, 2, int(KEPT), int(QUATERNION)}) {
      std::vector<PackedGrain> grains = untouched(count);
      const std::vector<unsigned char> symmetry(count, alike);
      pack_axes(columns.rows(false), symmetry.data(), grains.data());
      for (int i = 0; i < count; i++) expect_axis(columns, i, alike, grains[i]);
      expect_untouched(grains[count], count);
    }
  }
}

/** Every mixture of five in a row, so that the odd one is anywhere in a group and behind it. */
TEST(packed_grain, axes_of_grains_that_are_not_alike) {
  constexpr int count = 5;
  const Columns columns(count);
  for (int mixture = 0; mixture < 5 * 5 * 5 * 5 * 5; mixture++) {
    unsigned char symmetry[count];
    for (int i = 0, rest = mixture; i < count; i++, rest /= 5) symmetry[i] = rest % 5;
    std::vector<PackedGrain> grains = untouched(count);
    pack_axes(columns.rows(false), symmetry, grains.data());
    for (int i = 0; i < count; i++) expect_axis(columns, i, symmetry[i], grains[i]);
    expect_untouched(grains[count], count);
  }
}

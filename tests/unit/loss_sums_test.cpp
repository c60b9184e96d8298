// SPDX-License-Identifier: GPL-2.0-or-later
#include "loss_sums.h"
#include "make_contact.h"
#include <gtest/gtest.h>

using grainscope::LossSums;

namespace {

grainscope::Contact at_wall() {
  grainscope::Contact c = make_contact();
  c.partner = grainscope::PartnerWall();
  return c;
}

}

TEST(loss_sums, one_contact_by_hand) {
  LossSums sums;
  sums.add(make_contact());
  EXPECT_DOUBLE_EQ(sums.of_grains()[LossSums::normal_damping], 2.0);  // -4 x -0.5
  EXPECT_DOUBLE_EQ(sums.of_grains()[LossSums::friction], 6.0);        // -3 x -2
  EXPECT_DOUBLE_EQ(sums.of_grains()[LossSums::contacts], 1.0);
  EXPECT_DOUBLE_EQ(sums.of_grains()[LossSums::sliding], 1.0);
  for (int k = 0; k < LossSums::WIDTH; k++) EXPECT_EQ(sums.of_walls()[k], 0.0);
}

TEST(loss_sums, contacts_with_walls_stand_apart) {
  LossSums grains, walls;
  grains.add(make_contact());
  walls.add(at_wall());
  for (int k = 0; k < LossSums::WIDTH; k++) {
    EXPECT_EQ(walls.of_walls()[k], grains.of_grains()[k]);
    EXPECT_EQ(walls.of_grains()[k], 0.0);
  }
}

TEST(loss_sums, slip_is_an_energy) {
  LossSums sums;
  sums.of = LossSums::Of::slip;
  sums.add(at_wall());
  EXPECT_DOUBLE_EQ(sums.of_walls()[LossSums::friction], 0.006);  // 3 x 0.002
  EXPECT_EQ(sums.of_walls()[LossSums::normal_damping], 0.0);
}

// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_network.h"
#include "make_contact.h"
#include <gtest/gtest.h>

using grainscope::ConnectedSets;
using grainscope::Contact;
using grainscope::RattlerSearch;

namespace {

Contact between(int i, int j, bool ghost = false) {
  Contact c = make_contact(ghost ? 0.5 : 1.0);
  c.i = i;
  c.partner = grainscope::PartnerGrain{j, ghost};
  return c;
}

void add(RattlerSearch &search, const Contact &c) {
  search.add(c, c.i, c.with_wall() ? RattlerSearch::wall : c.j(), c.weight);
}

Contact with_wall(int i) {
  Contact c = make_contact();
  c.i = i;
  c.partner = grainscope::PartnerWall{};
  return c;
}

}

TEST(contact_network, rattlers_are_removed_until_none_is_left) {
  RattlerSearch search;  // a triangle 0 1 2 with a tail 2 3 4
  for (const Contact &c : {between(0, 1), between(1, 2), between(2, 0), between(2, 3), between(3, 4)}) add(search, c);
  std::vector<double> held(5, 1.0);
  EXPECT_TRUE(search.remove(2, 5, held));
  EXPECT_EQ(held, (std::vector<double>{1.0, 1.0, 1.0, 0.0, 0.0}));
  EXPECT_FALSE(search.remove(2, 5, held));
  EXPECT_EQ(search.contacts(held)[0], 3.0);
  EXPECT_TRUE(search.remove(3, 5, held));
  EXPECT_EQ(held, std::vector<double>(5, 0.0));
  EXPECT_EQ(search.contacts(held)[0], 0.0);
}

TEST(contact_network, a_wall_holds_and_is_no_grain) {
  RattlerSearch search;
  for (const Contact &c : {with_wall(0), between(0, 1), with_wall(1)}) add(search, c);
  std::vector<double> held(2, 1.0);
  EXPECT_FALSE(search.remove(2, 2, held));
  EXPECT_EQ(search.contacts(held)[0], 1.0);
  EXPECT_EQ(search.contacts(held)[1], 2.0);
}

TEST(contact_network, a_ghost_is_removed_by_its_owner_alone) {
  RattlerSearch search;
  add(search, between(0, 1, true));
  std::vector<double> held(2, 1.0);
  EXPECT_FALSE(search.remove(1, 1, held));
  EXPECT_EQ(search.contacts(held)[0], 0.5);
  held[1] = 0.0;  // by its owner
  EXPECT_TRUE(search.remove(1, 1, held));
  EXPECT_EQ(held[0], 0.0);
  search.reset();
  EXPECT_EQ(search.contacts({1.0, 1.0})[0], 0.0);
}

TEST(contact_network, a_clump_has_the_contacts_of_its_spheres) {
  RattlerSearch search;  // spheres 0 and 1 of clump 3, each at sphere 2
  for (int i : {0, 1}) search.add(between(i, 2), 3, 2, 1.0);
  std::vector<double> held = {0.0, 0.0, 1.0, 1.0};
  EXPECT_EQ(search.degrees(held), (std::vector<double>{0.0, 0.0, 2.0, 2.0}));
  EXPECT_FALSE(search.remove(2, 3, held));
  EXPECT_TRUE(search.remove(3, 3, held));
  EXPECT_EQ(held[3], 1.0);  // not the rank's to remove
  EXPECT_EQ(search.degrees(held)[3], 0.0);
}

TEST(contact_network, sets_have_their_lowest_number) {
  ConnectedSets sets(6);
  sets.join(0, 3);
  sets.join(3, 5);
  sets.join(1, 2);
  std::vector<double> numbers = {9.0, 4.0, 6.0, 3.0, 8.0, 7.0};
  EXPECT_TRUE(sets.spread_lowest(numbers));
  EXPECT_EQ(numbers, (std::vector<double>{3.0, 4.0, 4.0, 3.0, 8.0, 3.0}));
  EXPECT_FALSE(sets.spread_lowest(numbers));
}

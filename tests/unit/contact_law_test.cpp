// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_law.h"
#include <gtest/gtest.h>

using grainscope::Contact;
using grainscope::ContactLaw;
using grainscope::TangentialLaw;

namespace {

/** A law that every measure knows. */
ContactLaw known() {
  ContactLaw law;
  law.models = "model hertz tangential history";
  law.tangential = TangentialLaw::spring;
  law.elastic = true;
  law.cohesive = false;
  law.known_surface = true;
  return law;
}

bool mentions(const std::string &text, const std::string &word) { return text.find(word) != std::string::npos; }

}

TEST(contact_law, nothing_is_in_the_way_of_known_models) {
  EXPECT_EQ(known().why_no_losses(), "");
  EXPECT_EQ(known().why_no_energy(), "");
  EXPECT_TRUE(known().knows_sliding() && known().knows_stiffness() && known().sticks());
}

TEST(contact_law, names_the_model_that_a_measure_does_not_know) {
  ContactLaw law = known();
  law.elastic = false;
  EXPECT_TRUE(mentions(law.why_no_losses(), "works with the normal models hertz, hooke"));
  EXPECT_TRUE(mentions(law.why_no_energy(), "got 'model hertz tangential history'"));
  law = known();
  law.tangential = TangentialLaw::unknown;
  EXPECT_TRUE(mentions(law.why_no_losses(), "'tangential' off, no_history and history"));
  EXPECT_TRUE(law.sticks());  // assumed: a bound on the time step must not be too large
  law = known();
  law.cohesive = true;
  EXPECT_EQ(law.why_no_losses(), "");
  EXPECT_TRUE(mentions(law.why_no_energy(), "cohesion"));
  law = known();
  law.rolls = true;
  EXPECT_TRUE(mentions(law.why_no_energy(), "rolling_friction"));
  law.known_rolling = true;
  EXPECT_EQ(law.why_no_energy(), "");
  law.known_surface = false;
  EXPECT_TRUE(mentions(law.why_no_energy(), "surface"));
}

TEST(contact_law, a_law_that_nobody_filled_in_is_known_to_no_measure) {
  EXPECT_NE(ContactLaw().why_no_losses(), "");
  EXPECT_NE(ContactLaw().why_no_energy(), "");
  EXPECT_FALSE(ContactLaw().keeps_past());
}

TEST(contact_law, friction_without_a_table_is_none) {
  EXPECT_EQ(ContactLaw().friction_coefficient(1, 2), 0.0);
  EXPECT_DOUBLE_EQ(ContactLaw::friction_limit(0.3, -10.0), 3.0);  // cohesion may pull
}

TEST(contact, has_nothing_that_nobody_filled_in) {
  const Contact c;
  EXPECT_FALSE(c.motion || c.past || c.spring || c.rolling || c.with_wall() || c.ghost() || c.sliding);
  EXPECT_EQ(c.i, -1);
  EXPECT_EQ(c.j(), -1);
  EXPECT_TRUE(c.force.isZero(0.0) && c.branch.isZero(0.0));
}

TEST(contact, with_a_wall_has_no_other_grain) {
  Contact c;
  c.partner = grainscope::PartnerWall{2, 17};
  EXPECT_TRUE(c.with_wall());
  EXPECT_EQ(c.wall().triangle, 17);
  EXPECT_FALSE(c.with_own_grain());
  EXPECT_FALSE(c.ghost());
  EXPECT_THROW(c.j(), std::bad_variant_access);
  EXPECT_EQ(c.wall().wall, 2);
}

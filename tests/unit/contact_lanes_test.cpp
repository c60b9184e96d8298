// SPDX-License-Identifier: GPL-2.0-or-later
/** Sums over contacts that come four at a time, against those of the same contacts one by one. */
#include "grain_power.h"
#include "loss_lanes.h"
#include "random_contacts.h"
#include "stress_lanes.h"

using namespace random_contacts;

namespace {

std::vector<RandomContacts> cases() {
  return {RandomContacts(TangentialLaw::spring), RandomContacts(TangentialLaw::spring, 0.0),
          RandomContacts(TangentialLaw::spring, 5.0, true), RandomContacts(TangentialLaw::viscous),
          RandomContacts(TangentialLaw::none)};
}

}

TEST(contact_lanes, stress_is_that_of_single_contacts) {
  for (RandomContacts &random : cases()) {
    StressSums single, sums;
    OffPlace<StressLanes> lanes;
    random.many([&](const ContactLanes &c) { lanes.here.add(c, sums); }, [&](const Contact &c) { single.add(c); });
    lanes.here.move_to(sums);
    expect_near(sums.sums, single.sums);
    EXPECT_EQ(sums.largest_overlap, single.largest_overlap);
    for (int k = 18; k < 21; k++) EXPECT_EQ(sums.sums[k], single.sums[k]);
    lanes.here.move_to(sums);  // what was moved is gone
    expect_near(sums.sums, single.sums);
  }
}

TEST(contact_lanes, losses_are_those_of_single_contacts) {
  for (LossSums::Of of : {LossSums::Of::powers, LossSums::Of::slip, LossSums::Of::contacts})
    for (RandomContacts &random : cases()) {
      LossSums single, sums;
      OffPlace<LossLanes> lanes;
      single.of = sums.of = of;
      random.many([&](const ContactLanes &c) { lanes.here.add(c, sums); }, [&](const Contact &c) { single.add(c); });
      lanes.here.move_to(sums);
      expect_near(sums.all, single.all);
    }
}

TEST(contact_lanes, damping_powers_are_those_of_single_contacts) {
  for (int bit : {0, 2})
    for (RandomContacts &random : cases()) {
      GrainPower normal, tangential, single_normal, single_tangential;
      for (GrainPower *one : {&normal, &tangential, &single_normal, &single_tangential}) one->reset(OWN);
      const GrainPower::Images images{random.edges, random.shifts, random.mask, bit};
      random.many([&](const ContactLanes &c) { GrainPower::add_damping(c, images, normal, tangential); },
                  [&](const Contact &c) {
                    const ContactMotion &m = *c.motion;
                    Vector3d image = Vector3d::Zero();
                    if (c.ghost() && (random.mask[c.j()] & bit))
                      image = random.edges * Eigen::Map<const Vector3d>(random.shifts + 3 * c.j());
                    const auto add = [&](GrainPower &to, const Vector3d &force) {
                      to.add(c, force, m.arm, m.arm + c.branch, image);
                    };
                    add(single_normal, m.normal_damping * c.normal);
                    if (m.damped) add(single_tangential, -m.tangential_damping * m.tangential_velocity);
                  });
      double v[3 * OWN], omega[3 * OWN];
      for (double &x : v) x = random.uniform(-1, 1);
      for (double &x : omega) x = random.uniform(-1, 1);
      expect_near(std::vector<double>{normal.power(v, omega), tangential.power(v, omega)},
                  std::vector<double>{single_normal.power(v, omega), single_tangential.power(v, omega)});
    }
}

// SPDX-License-Identifier: GPL-2.0-or-later
/** The ledger of contacts and grains that come four at a time, against that of the same one by one. */
#include "energy_ledger.h"
#include "random_contacts.h"
#include "spheroid_rotation.h"

using namespace random_contacts;

namespace {

constexpr int HELD = 8, MEMBER = 2;  // bits of masks
enum class Shapes { spheres, discs, spheroids, mixed };

/** Grains in rows, with room for one of four numbers behind the last. */
class RandomGrains {
 public:
  RandomGrains(int n, Shapes shapes, RandomContacts &random)
      : n_(n), shapes_(shapes), random_(random), mask_(n, 3), mass_(n), radius_(n), x_(numbers(3)), v_(numbers(3)),
        force_(numbers(3)), torque_(numbers(3)), omega_(numbers(3)), momentum_(numbers(3)), inertia_(3 * n),
        quaternion_(numbers(4)) {
    for (int i = 0; i < n; i++) {
      mass_[i] = random.uniform(1, 2);
      radius_[i] = random.uniform(1, 2);
      Eigen::Map<Eigen::Vector4d>(&quaternion_[4 * i]).normalize();
      const int axis = shapes == Shapes::mixed ? i / 5 % 3 : 2;
      for (int a = 0; a < 3; a++) inertia_[3 * i + a] = a == axis ? 1.0 + 0.1 * (i % 7) : 1.3;
      if (shapes == Shapes::mixed && i == 21) inertia_[3 * i] *= 1.0 + 1e-8;  // triaxial, but hardly
    }
  }
  void move() {
    for (std::vector<double> *some : {&x_, &v_, &force_, &torque_, &omega_, &momentum_}) *some = numbers(3);
  }
  void mark(int i, int bits) { mask_[i] ^= bits; }

  /** What the ledger is shown of those that it knows: side by side where it takes them, or alone. */
  void start(EnergyLedger &ledger, int bit, bool many) {
    show(
        bit, many, [&](const EnergyLedger::Grains &g, int i) { return ledger.start_of_step(g, i, DT); },
        [&](int i) {
          double momentum[3], kicked[3], spin[3];
          momentum_of(i, momentum);
          for (int a = 0; a < 3; a++) {
            kicked[a] = momentum[a] + 0.5 * DT * torque_[3 * i + a];
            spin[a] = kicked[a] / sphere_inertia(i);
          }
          if (tops()) spin_of(i, kicked, spin);
          ledger.start_of_step(grain(i), spin, momentum, DT);
        });
  }
  void end(EnergyLedger &ledger, int bit, bool many) {
    show(
        bit, many, [&](const EnergyLedger::Grains &g, int i) { return ledger.end_of_step(g, i, DT); },
        [&](int i) {
          double momentum[3];
          momentum_of(i, momentum);
          ledger.end_of_step(grain(i), &omega_[3 * i], momentum, DT);
        });
  }
  EnergyLedger::Members members(int bit) const { return {mask_.data(), bit, nullptr}; }
  int taken = 0;  // side by side

 private:
  int n_;
  Shapes shapes_;
  RandomContacts &random_;
  std::vector<int> mask_;
  std::vector<double> mass_, radius_, x_, v_, force_, torque_, omega_, momentum_, inertia_, quaternion_;

  std::vector<double> numbers(int columns) {
    std::vector<double> some(columns * n_);
    for (double &one : some) one = random_.uniform(-1, 1);
    return some;
  }
  bool tops() const { return shapes_ == Shapes::spheroids || shapes_ == Shapes::mixed; }
  double factor() const { return shapes_ == Shapes::discs ? 0.5 : 0.4; }
  double sphere_inertia(int i) const { return factor() * mass_[i] * radius_[i] * radius_[i]; }
  void momentum_of(int i, double momentum[3]) const {
    for (int a = 0; a < 3; a++) momentum[a] = tops() ? momentum_[3 * i + a] : sphere_inertia(i) * omega_[3 * i + a];
  }
  /** R (R^T L)/I, whatever the symmetry. */
  void spin_of(int i, const double momentum[3], double spin[3]) const {
    const double *q = &quaternion_[4 * i];
    const Eigen::Matrix3d r = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
    Eigen::Map<Vector3d>(spin + 0) = r * (r.transpose() * Eigen::Map<const Vector3d>(momentum + 0))
                                             .cwiseQuotient(Eigen::Map<const Vector3d>(&inertia_[3 * i]));
  }
  EnergyLedger::Grain grain(int i) const {
    static const double none[3] = {};
    const bool held = mask_[i] & HELD;
    return {i, mass_[i], &x_[3 * i], &v_[3 * i], held ? none : &force_[3 * i], held ? none : &torque_[3 * i]};
  }

  template <class Many, class One>
  void show(int bit, bool many, const Many &side_by_side, const One &alone) {
    const EnergyLedger::Grains all{n_,
                                   mask_.data(),
                                   bit,
                                   HELD,
                                   mass_.data(),
                                   x_.data(),
                                   v_.data(),
                                   force_.data(),
                                   torque_.data(),
                                   omega_.data(),
                                   tops() ? momentum_.data() : nullptr,
                                   tops() ? inertia_.data() : nullptr,
                                   tops() ? quaternion_.data() : nullptr,
                                   radius_.data(),
                                   factor()};
    for (int i = 0; i < n_;) {
      if (many) {
        const int next = side_by_side(all, i);
        taken += next - i;
        i = next;
      }
      for (const int last = std::min(i + LANES, n_); i < last; i++)
        if (mask_[i] & bit) alone(i);
    }
  }
};

LedgerFrame flow(double shear, double rate) {
  LedgerFrame frame;
  frame.velocity_gradient << rate, shear, -0.2, 0.0, -0.3 * rate, 0.4, 0.0, 0.0, 2.0 * rate;
  frame.edge_lengths << 8.0, 9.0, 10.0;
  frame.edge_rates = frame.velocity_gradient.diagonal().cwiseProduct(frame.edge_lengths);
  frame.centre << 0.3, -0.1, 0.2;
  return frame;
}

/** Everything that it has booked. */
std::vector<double> numbers_of(const EnergyLedger &ledger) {
  const EnergyLedger::State state = ledger.state();
  std::vector<double> all(state.begin(), state.end());
  all.insert(all.end(), ledger.stored().begin(), ledger.stored().end());
  return all;
}

std::vector<RandomContacts> cases() {
  return {RandomContacts(TangentialLaw::spring),
          RandomContacts(TangentialLaw::spring, 0.0),
          RandomContacts(TangentialLaw::spring, 5.0, true, 1.0),
          RandomContacts(TangentialLaw::spring, 0.4, false, 1.3),
          RandomContacts(TangentialLaw::viscous),
          RandomContacts(TangentialLaw::spring, 5.0).synchronized(),
          RandomContacts(TangentialLaw::viscous).synchronized(),
          RandomContacts(TangentialLaw::none)};
}

}

TEST(energy_ledger_lanes, contacts_side_by_side_are_those_one_by_one) {
  int damped = 0;
  for (int bit : {1, MEMBER})
    for (RandomContacts &random : cases()) {
      RandomGrains grains(OWN, Shapes::spheres, random);
      for (int i : {2, 5}) grains.mark(i, MEMBER);
      OffPlace<EnergyLedger> lanes;
      EnergyLedger single;
      // Members are asked for ghosts, too: as the first grains are.
      int mask[ALL];
      for (int i = 0; i < ALL; i++) mask[i] = grains.members(bit).mask[i % OWN];
      const EnergyLedger::Members members{mask, bit, nullptr};
      for (EnergyLedger *ledger : {&lanes.here, &single}) {
        ledger->set_laws(random.law());
        ledger->begin_evaluation(OWN);
        ledger->begin_start_of_step(flow(0.7, 0.1));
        grains.start(*ledger, bit, false);
        ledger->book_start(DT);
      }
      for (int step = 0; step < 3; step++) {
        for (EnergyLedger *ledger : {&lanes.here, &single}) ledger->begin_evaluation(OWN);
        random.many([&](const ContactLanes &c) { lanes.here.add(c, members); },
                    [&](const Contact &c) {
                      single.add({&c, 1}, members, DT, true);
                    });
        grains.move();
        for (EnergyLedger *ledger : {&lanes.here, &single}) {
          ledger->end_evaluation();
          ledger->begin_end_of_step();
          grains.end(*ledger, bit, false);
          ledger->book_step(DT);
          ledger->begin_start_of_step(flow(0.7, 0.1));
          grains.start(*ledger, bit, false);
          ledger->book_start(DT);
        }
        expect_near(numbers_of(lanes.here), numbers_of(single));
      }
      damped += lanes.here.totals()[EnergyLedger::D_damp] != 0.0;
    }
  EXPECT_EQ(damped, 2 * 6);  // all but those without friction, which slide
}

/** More grains on the rank, or fewer, than in the evaluation before: what was for ghosts is nobody's. */
TEST(energy_ledger_lanes, ghosts_of_the_step_before_are_no_grains) {
  RandomContacts random(TangentialLaw::spring);
  for (int own : {OWN - 1, OWN, OWN + 3}) {
    RandomGrains before(OWN, Shapes::spheres, random), after(own, Shapes::spheres, random);
    EnergyLedger lanes, single;
    for (EnergyLedger *ledger : {&lanes, &single}) {
      ledger->set_laws(random.law());
      ledger->begin_evaluation(OWN);
    }
    int mask[ALL];
    std::fill(mask, mask + ALL, 1);
    random.many(
        [&](const ContactLanes &c) {
          lanes.add(c, {mask, 1, nullptr});
        },
        [&](const Contact &c) {
          single.add({&c, 1}, {mask, 1, nullptr}, DT, true);
        });
    for (EnergyLedger *ledger : {&lanes, &single}) {
      ledger->end_evaluation();
      ledger->begin_start_of_step(flow(0.7, 0.1));
      before.start(*ledger, 1, false);
      ledger->book_start(DT);
      ledger->begin_evaluation(own);
    }
    random.many([](const ContactLanes &) {},
                [&](const Contact &c) {
                  if (c.i >= own || (!c.ghost() && c.j() >= own)) return;
                  for (EnergyLedger *ledger : {&lanes, &single}) ledger->add({&c, 1}, {mask, 1, nullptr}, DT, true);
                });
    for (EnergyLedger *ledger : {&lanes, &single}) {
      ledger->begin_end_of_step();
      after.end(*ledger, 1, false);
      ledger->book_step(DT);
    }
    expect_near(numbers_of(lanes), numbers_of(single));
  }
}

/** A grain that leaves the group between two steps and comes back after the next: its work has no force from before. */
TEST(energy_ledger_lanes, a_grain_that_comes_again_brings_no_force_from_before) {
  for (bool side_by_side : {false, true}) {
    RandomContacts random(TangentialLaw::spring);
    RandomGrains grains(OWN, Shapes::spheres, random);
    EnergyLedger long_ago, since;  // one was there before the grain left
    const auto evaluate = [&](std::initializer_list<EnergyLedger *> ledgers) {
      int mask[ALL];
      for (int i = 0; i < ALL; i++) mask[i] = grains.members(MEMBER).mask[i % OWN];
      for (EnergyLedger *ledger : ledgers) ledger->begin_evaluation(OWN);
      random.many([](const ContactLanes &) {},
                  [&](const Contact &c) {
                    for (EnergyLedger *ledger : ledgers) ledger->add({&c, 1}, {mask, MEMBER, nullptr}, DT, true);
                  });
      for (EnergyLedger *ledger : ledgers) ledger->end_evaluation();
    };
    const auto start = [&](EnergyLedger &ledger) {
      ledger.begin_start_of_step(LedgerFrame());
      grains.start(ledger, MEMBER, side_by_side);
      ledger.book_start(DT);
    };
    const auto end = [&](EnergyLedger &ledger) {
      ledger.begin_end_of_step();
      grains.end(ledger, MEMBER, side_by_side);
      ledger.book_step(DT);
    };
    for (EnergyLedger *ledger : {&long_ago, &since}) ledger->set_laws(random.law());
    evaluate({&long_ago});
    grains.mark(1, MEMBER);
    start(long_ago);
    evaluate({&long_ago, &since});
    end(long_ago);
    grains.mark(1, MEMBER);
    std::vector<double> booked[2];
    for (EnergyLedger *ledger : {&long_ago, &since}) start(*ledger);
    const EnergyLedger::Entries before[] = {long_ago.totals(), since.totals()};
    evaluate({&long_ago, &since});
    for (EnergyLedger *ledger : {&long_ago, &since}) end(*ledger);
    const EnergyLedger::Entries after[] = {long_ago.totals(), since.totals()};
    for (int k = 0; k < 2 * EnergyLedger::entries; k++)
      booked[k % 2].push_back(after[k % 2][k / 2] - before[k % 2][k / 2]);
    expect_near(booked[0], booked[1]);
  }
}

TEST(energy_ledger_lanes, grains_side_by_side_are_those_one_by_one) {
  for (Shapes shapes : {Shapes::spheres, Shapes::discs, Shapes::spheroids, Shapes::mixed})
    for (int n : {1, 4, 5, 8, 9, 31})
      for (int bit : {1, MEMBER}) {
        RandomContacts random(TangentialLaw::spring);
        RandomGrains grains(n, shapes, random);
        if (n == 31) {
          grains.mark(9, MEMBER);
          grains.mark(18, HELD);
        }
        OffPlace<EnergyLedger> many;
        EnergyLedger single;
        for (EnergyLedger *ledger : {&many.here, &single}) ledger->set_laws(random.law());
        for (int step = 0; step < 5; step++) {
          // the frame goes on, is moved, is driven
          const LedgerFrame frame = flow(step < 2 ? 0.7 : 0.5, step < 3 ? 0.1 : 0.15);
          for (EnergyLedger *ledger : {&many.here, &single}) ledger->begin_evaluation(n);
          random.many([](const ContactLanes &) {},
                      [&](const Contact &c) {
                        if (std::max(c.i, c.j()) >= std::min(n, OWN)) return;
                        for (EnergyLedger *ledger : {&many.here, &single})
                          ledger->add({&c, 1}, grains.members(bit), DT, true);
                      });
          for (EnergyLedger *ledger : {&many.here, &single}) {
            const bool side_by_side = ledger == &many.here;
            if (step > 0) {
              ledger->begin_end_of_step();
              grains.end(*ledger, bit, side_by_side);
              ledger->book_step(DT);
            }
            ledger->begin_start_of_step(frame);
            grains.start(*ledger, bit, side_by_side);
            ledger->book_start(DT);
          }
          expect_near(numbers_of(many.here), numbers_of(single));
          grains.move();
        }
        EXPECT_EQ(grains.taken > 0, n > LANES);
      }
}

/** Of contacts that touch: what their history holds is taken if it is of the evaluation before, and what they are now
 *  is left there. */
TEST(energy_ledger_lanes, the_past_is_taken_from_the_history_and_renewed) {
  RandomContacts random = RandomContacts(TangentialLaw::spring).synchronized();
  const double half = 0.5 * DT;
  double history[LANES][9];
  random.many(
      [&](const ContactLanes &c) {
        PairGroup group = c.group;
        double before[LANES][9];
        for (int k = 0; k < LANES; k++) {
          for (double &x : history[k]) x = random.uniform(0, 1);
          history[k][2] = random.uniform(0, 1) < 0.7 ? 41.5 : 40.5;
          group.history[k] = history[k];
        }
        std::copy(&history[0][0], &history[0][0] + 9 * LANES, &before[0][0]);
        OffPlace<PastLanes> past;
        renew_past(group, c.geometry.touching, c.forces, {2, 42.5, 41.5, half}, past.here);
        const GroupForces &f = c.forces;
        for (int k = 0; k < LANES; k++) {
          const double *was = before[k] + 2, *is = history[k] + 2;
          const bool touching = c.geometry.touching[k], known = touching && was[0] == 41.5;
          EXPECT_EQ(past.here.known[k] != 0, known);
          EXPECT_EQ(past.here.overlap[k], known ? was[1] : 0.0);
          EXPECT_EQ(past.here.elastic_force[k], known ? was[2] : 0.0);
          EXPECT_EQ(past.here.tangential_stiffness[k], known ? was[3] : 0.0);
          EXPECT_EQ(past.here.elastic_work[k], known ? was[4] : 0.0);
          EXPECT_EQ(past.here.spring_work[k], known ? was[5] : 0.0);
          for (int l : {0, 1, 8}) EXPECT_EQ(history[k][l], before[k][l]);
          if (!touching) {
            EXPECT_TRUE(std::equal(is, is + 6, was));
            continue;
          }
          const double elastic = f.kn[k] * f.overlap[k];
          double moved = 0.0;
          for (int l = 0; l < 3; l++) moved += f.after[l][k] * f.tangential_at_force[l][k];
          EXPECT_EQ(is[0], 42.5);
          EXPECT_EQ(is[1], f.overlap[k]);
          EXPECT_EQ(is[2], elastic);
          EXPECT_EQ(is[3], f.kt[k]);
          EXPECT_EQ(is[4], -half * elastic * f.normal_at_force[k]);
          EXPECT_EQ(is[5], half * f.kt[k] * moved);
        }
      },
      [](const Contact &) {});
}

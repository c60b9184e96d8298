// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ENERGY_LEDGER_H
#define GRAINSCOPE_ENERGY_LEDGER_H

#include "affine_flow.h"
#include "contact_law.h"
#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace grainscope {

/** The flow that velocities are measured against, and how fast the edges of the box change in length. */
struct LedgerFrame : AffineFlow {
  Eigen::Vector3d edge_lengths = Eigen::Vector3d::Ones();  // diagonal of H
  Eigen::Vector3d edge_rates = Eigen::Vector3d::Zero();    // diagonal of dH/dt
};

/** Where the energy of a group of grains goes, exactly as velocity Verlet moves it: what enters, what is stored, what
 *  is lost. Every entry is a sum over this rank's grains and contacts; sums over ranks are the truth. Losses and
 *  supplies are positive.
 *
 *  The step from n to n+1 moves x^n to x^{n+1} with v = v^{n+1/2}, so that (F^n + F^{n+1})/2 . v dt, each force with
 *  its own lever arms, is exactly the change of K = sum m v^2/2 - dt^2 F^2/8m, and likewise for rotations. Velocities
 *  are peculiar, p = v - L (x - x_c); in terms of contact velocities u, sum_grains F.p + T.w = sum_contacts F.u -
 *  F.L r.
 *
 *  Per contact, s the tangential spring, 0 and 1 the two ends of the step, `cut` what friction takes from the spring:
 *    D_t = (k0 s0 + k1 s1)/2 . cut          G_k = -(k1 - k0)/2 s0.s1          (k_t follows the overlap,
 *      the spring does not)
 *    G_p: the rest of the spring's work, (k0 s0.u0 + k1 s1.u1) dt/2 = dU_t + D_t + G_k + G_p: the spring is turned into
 *      the contact plane
 *    G_open: the spring of a contact that opens, with the work of its last half step
 *    G_n: work of the elastic normal force that follows neither the overlap d nor the stiffness:
 *      -(F0 n0.u0 + F1 n1.u1) dt/2 - (F0 + F1)/2 (d1 - d0) - (dU_n/dk)_mean dk
 *    G_dt: what that trapezium rule over the overlap differs from dU_n: the error of the time step, of second
 *      order in dt
 *  Then all terms cancel: what is left is rounding, the rotation of an integrator that does not conserve the energy of
 *  a free grain, and whatever moved the grains or their velocities behind the ledger's back.
 *  Source of the identities: velocity Verlet (kick, drift, kick); see doc/compute_energy_ledger.md. */
class EnergyLedger {
 public:
  /** Rows of the account, each an energy. */
  enum Entry { W_shear, W_box, W_frame, W_other, D_n, D_t, D_damp, D_rolling, G_k, G_p, G_n, G_open, G_dt, entries };
  enum Store { U_n, U_t, K_tr, K_rot, stores };
  using Entries = std::array<double, entries>;
  using Stores = std::array<double, stores>;

  /** One grain: three components each, in the laboratory frame. */
  struct Grain {
    int index;
    double mass;
    const double *x, *v, *force, *torque;
  };

  void set_law(const ContactLaw &law);

  /** A force evaluation begins: forget the contacts of the last. `repeats`: it repeats the last, where a run goes on as
   *  if it had not ended. */
  void begin_evaluation(int n_local, bool repeats = false);
  /** A contact of two grains of the group. `springs_move`: false in the first evaluation of a run. */
  void add(const Contact &contact, double dt, bool springs_move);

  /** After the forces of step n are complete, before the second kick: v = v^{n-1/2}, x = x^n; angular velocity and
   *  momentum likewise. */
  void begin_end_of_step() { ends_ = Ends(); }
  void end_of_step(const Grain &grain, const double omega[3], const double momentum[3], double dt);
  /** Books the step from n-1 to n. */
  void book_step(double dt);

  /** Before the first kick of the next step, with all that was changed since: v = v^n. Angular velocity, after the
   *  kick, and momentum, before it: inertia w = L + torque dt/2. */
  void begin_start_of_step(const LedgerFrame &frame);
  void start_of_step(const Grain &grain, const double omega_after[3], const double momentum[3], double dt);
  /** Books what was changed between the steps, and takes the frame. */
  void book_start(double dt);

  /** The forces were evaluated and no step was booked since: at the beginning of a run, or in the middle of a step. */
  bool pending() const { return !stepped_; }
  /** This rank's part of everything booked, of the last step alone, and of what is stored now. */
  Entries totals() const;
  const Entries &last() const { return last_; }
  const Stores &stored() const { return stored_; }
  const Stores &stored_before() const { return stored_before_; }
  double start_energy() const { return start_energy_; }
  /** W - D - G - (stored - stored at the start), of `totals` with all W, D and G positive, as described above. */
  static double residual(const Entries &totals, double stored_change);

  /** State for restart files; sums over ranks may be given to one rank. */
  using State = std::array<double, 2 * entries + 1 + 2 * stores>;
  /** False before the first step: there is no state yet. */
  bool started() const { return started_; }
  State state() const;
  const LedgerFrame &frame() const { return frame_; }
  void restore(const State &state, const LedgerFrame &frame);

 private:
  enum Part { elastic, damping, spring, viscous, rolling, parts };
  /** Eight numbers of each part: force, -, torque, - on a grain; or in sums over contacts F_a r_b xx yy zz, F.u, F_a
   *  r_b yz xz xy, -. */
  static constexpr int power_place = 3;
  /** Sums over the contacts of one evaluation. */
  struct Contacts {
    double sums[parts][8] = {};
    double normal_energy = 0.0, spring_energy = 0.0;
    double elastic_path = 0.0;  // (F0 + F1)/2 dd + (dU/dk) dk of contacts that touched before
    double new_elastic = 0.0;   // the half step's work of those that did not
    double kept_elastic = 0.0, kept_spring = 0.0, kept_energy = 0.0;  // of the past of those that did
    double friction = 0.0, stiffening = 0.0, travel = 0.0, revived = 0.0;
  };
  struct Ends {
    double k_tr = 0.0, k_rot = 0.0, other[4] = {};
  };  // arrays: three terms of a sum, dt/2 times
  struct Starts {
    double rate[parts][4] = {}, work[parts] = {}, other[4] = {}, shear = 0.0, box = 0.0;
    // in the frame of the last step, in that carried on, in the next
    double k_old = 0.0, k_carried = 0.0, k_new = 0.0, k_rot = 0.0;
  };

  /** What of the contact law there is to be booked. */
  struct Law {
    double exponent = 1.5;
    bool spring = false;   // a tangential one
    bool viscous = false;  // tangential damping, or friction without a spring
    bool rolling = false;
  };
  Law law_;
  double energy_factor_ = 0.4;  // U_n = energy_factor k_n overlap^2
  int slot_[parts];             // of a part in a grain's wrenches, or -1
  int slots_ = 0;
  std::vector<double> wrenches_;  // eight numbers for each part on each local grain
  bool cleared_ = false;          // and all are 0
  Contacts contacts_, before_;
  Ends ends_;
  Starts starts_;
  LedgerFrame frame_, next_, carried_;
  // the frame changed since the last step: carried on by its velocities, by new velocities
  bool moved_ = false, driven_ = false;
  bool stepped_ = false;  // the contacts were booked as the end of a step
  bool started_ = false;  // there was a step before
  Entries totals_{}, last_{}, between_{};
  Stores stored_{}, stored_before_{};
  Stores ended_{};  // at the end of the last step
  double start_energy_ = 0.0;

  double *wrenches_of(int i) { return &wrenches_[8 * static_cast<std::size_t>(i) * slots_]; }
  static double half_work(const Contacts &contacts, int part, double dt);
  struct Unit;
  void add_part(int part, double size, const Unit &unit, double *of_i, double *of_j);
  void add_past(const Contact &c, const ContactPast &past, double elastic_force);
  void add_spring(const Contact &c);
};

}

#endif

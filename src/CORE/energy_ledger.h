// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_ENERGY_LEDGER_H
#define GRAINSCOPE_ENERGY_LEDGER_H

#include "affine_flow.h"
#include "contact_lanes.h"
#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace grainscope {

/** The flow that velocities are relative to, and the rates at which the edges of the box change in length. */
struct LedgerFrame : AffineFlow {
  Eigen::Vector3d edge_lengths = Eigen::Vector3d::Ones();  // diagonal of H
  Eigen::Vector3d edge_rates = Eigen::Vector3d::Zero();    // diagonal of dH/dt
};

/** Where the energy of a group of grains goes, exactly as velocity Verlet moves the grains: what enters, what is
 *  stored, what is lost. Every entry is a sum over the grains and contacts of this rank; only sums over all ranks have
 *  a meaning. Losses and supplies are positive.
 *
 *  The step from n to n+1 moves x^n to x^{n+1} with v = v^{n+1/2}. So (F^n + F^{n+1})/2 . v dt, each force with its own
 *  lever arms, is exactly the change of K = sum m v^2/2 - dt^2 F^2/8m; likewise for rotations. Velocities are peculiar,
 *  p = v - L (x - x_c). In terms of contact velocities u, sum_grains F.p + T.w = sum_contacts F.u - F.L r. For a
 *  contact with a wall that moves with V at the contact point c, F.p + T.w = F.u - F.L r + F.P, where r = x - c, and
 *  P = V - L (c - x_c) is the velocity of the wall relative to the flow. F.P is the power of the wall: W_wall. The
 *  velocity of a wall at the end of a step is that of the whole step, because walls move before forces are evaluated;
 *  in a contact that goes on, both forces of the step are paired with it.
 *
 *  Per contact, with s the tangential spring, 0 and 1 the two ends of the step, `cut` what friction takes from the
 *  spring:
 *    D_t = (k0 s0 + k1 s1)/2 . cut          G_k = -(k1 - k0)/2 s0.s1          (k_t follows the overlap,
 *      the spring does not)
 *    G_p: the rest of the spring's work, (k0 s0.u0 + k1 s1.u1) dt/2 = dU_t + D_t + G_k + G_p: the spring is turned into
 *      the contact plane. With `time_level synchronized` s0 is the spring after it was turned, and u is still the
 *      velocity at x_n (Contact::at_force): the rest is then the difference between u and the velocity of the spring
 *    G_open: the spring of a contact that opens, with the work of its last half step
 *    G_n: work of the elastic normal force that follows neither the overlap d nor the stiffness:
 *      -(F0 n0.u0 + F1 n1.u1) dt/2 - (F0 + F1)/2 (d1 - d0) - (dU_n/dk)_mean dk
 *    G_dt: the difference of that trapezium rule over the overlap from dU_n: the error of the time step, of second
 *      order in dt
 *  Then all terms cancel. What is left is rounding, the rotation of an integrator that does not conserve the energy of
 *  a free grain, and changes of positions or velocities that the ledger did not see.
 *  Source of the identities: velocity Verlet (kick, drift, kick); see doc/compute_energy_ledger.md. */
class EnergyLedger {
 public:
  /** Rows of the account, each an energy. Those with _w are the share of contacts with walls; G_w is that of all G.
   *  Those with _x, _y, _z are the share of the edges along one axis in W_box, by the diagonal element of L there: from
   *  the components along that axis alone, F_a r_a and m p_a v_a, and the change of sum m p_a^2/2. */
  enum Entry {
    W_shear,
    W_box,
    W_frame,
    W_other,
    D_n,
    D_t,
    D_damp,
    D_rolling,
    G_k,
    G_p,
    G_n,
    G_open,
    G_dt,
    W_wall,
    W_gravity,
    W_in,
    W_out,
    D_n_w,
    D_t_w,
    D_damp_w,
    D_rolling_w,
    G_w,
    W_box_x,
    W_box_y,
    W_box_z,
    entries
  };
  enum Store { U_n, U_t, K_tr, K_rot, U_n_w, U_t_w, stores };
  using Entries = std::array<double, entries>;
  using Stores = std::array<double, stores>;

  /** One grain: three components each, in the laboratory frame. */
  struct Grain {
    int index;
    double mass;
    const double *x, *v, *force, *torque;
  };

  /** Many grains in arrays: rows of three numbers, of quaternions four. Spheroids; or, without quaternions, spheres of
   *  moment of inertia `inertia_factor` m r^2, whose inertia and momentum are not given. */
  struct Grains {
    int n;
    const int *mask;
    int bit, frozen;  // of the ledger; of grains that may be held still, whatever their force
    const double *mass, *x, *v, *force, *torque, *omega, *momentum, *inertia, *quaternion, *radius;
    double inertia_factor;

    bool four_free(int i) const;
  };

  /** What grains bring when they come and take when they leave: their kinetic energy, and the energy stored in contacts
   *  that exist only with them, by partner. */
  enum Partner { grains, walls, partners };
  struct Passage {
    double kinetic = 0.0;
    double normal[partners] = {}, spring[partners] = {};
    double all() const;
  };

  /** The laws of grains among each other, and of grains with each of the walls. */
  void set_laws(const ContactLaw &between_grains, const std::vector<const ContactLaw *> &with_walls = {});

  /** A force evaluation begins: the contacts of the last one are dropped. `repeats`: it repeats the last one, because a
   *  run continues as if uninterrupted. */
  void begin_evaluation(int n_local, bool repeats = false);
  /** The grains of the ledger: by local index, those with the bit. IDs identify them in any evaluation. */
  struct Members {
    const int *mask;
    int bit;
    const int *ids;
    /** The host's group all has bit 1. */
    bool all() const { return bit == 1; }
  };
  /** Contacts of members with each other and with walls. `springs_move`: false in the first evaluation of a run. */
  void add(ContactSpan contacts, const Members &members, double dt, bool springs_move);
  /** Contacts between grains side by side, with their past, in an evaluation that moves springs. */
  void add(const ContactLanes &contacts, const Members &members);
  void end_evaluation();

  /** After the forces of step n are complete, before the second kick: v = v^{n-1/2}, x = x^n; angular velocity and
   *  momentum likewise. */
  void begin_end_of_step() { ends_ = Ends(); }
  void end_of_step(const Grain &grain, const double omega[3], const double momentum[3], double dt);
  /** Takes grains from i on side by side, as many as possible; returns the first that it has not taken. The same at the
   *  start of a step. */
  int end_of_step(const Grains &grains, int i, double dt);
  /** The weight of the grain, whose work does not count as other work; the same at the start of a step. */
  void end_with_weight(const Grain &grain, const Eigen::Vector3d &weight);
  /** Grains left and came since the step began, before its forces were evaluated. Kinetic energies are those of the
   *  half step, without forces. The energy stored in a contact includes the work of its last or first half step. */
  void pass_in_step(const Passage &out, const Passage &in);
  /** Books the step from n-1 to n. */
  void book_step(double dt);

  /** Before the first kick of the next step, with all that was changed since: v = v^n. Angular velocity, after the
   *  kick, and momentum, before it: inertia w = L + torque dt/2. */
  void begin_start_of_step(const LedgerFrame &frame);
  void start_of_step(const Grain &grain, const double omega_after[3], const double momentum[3], double dt);
  int start_of_step(const Grains &grains, int i, double dt);
  void start_with_weight(const Grain &grain, const Eigen::Vector3d &weight, double dt);
  /** `given`: the part of the velocity of a grain that came with the change of the frame, because the grain lies beyond
   *  a face. After start_of_step(). */
  void start_with_jump(const Grain &grain, const Eigen::Vector3d &given);
  /** Books what was changed between the steps, and takes the frame. */
  void book_start(double dt);
  /** Grains left and came between two steps. */
  void pass_between_steps(const Passage &out, const Passage &in);

  /** The forces were evaluated and no step was booked since: at the beginning of a run, or in the middle of a step. */
  bool pending() const { return !stepped_; }
  /** This rank's part of everything booked, of the last step alone, and of what is stored now. */
  Entries totals() const;
  const Entries &last() const { return last_; }
  const Stores &stored() const { return stored_; }
  const Stores &stored_before() const { return stored_before_; }
  double start_energy() const { return start_energy_; }
  /** W - W_out - D - G - (stored - stored at the start), of `totals` with all W, D and G positive, as described
   *  above. */
  static double residual(const Entries &totals, double stored_change);
  /** U + K. */
  static double energy(const Stores &stored);
  /** Kinetic energy of a grain in the middle of a step, in the frame of that step. */
  double kinetic_in_step(const Grain &grain, const double omega[3], const double momentum[3]) const;
  /** And between two steps; arguments as of start_of_step(). */
  double kinetic_between_steps(const Grain &grain, const double omega_after[3], const double momentum[3],
                               double dt) const;

  /** State for restart files; sums over ranks may be given to one rank. */
  using State = std::array<double, 2 * entries + 1 + 2 * stores>;
  /** False before the first step: there is no state yet. */
  bool started() const { return started_; }
  State state() const;
  const LedgerFrame &frame() const { return frame_; }
  void restore(const State &state, const LedgerFrame &frame);

 private:
  enum Part { elastic, damping, spring, sliding, viscous, rolling, parts };
  /** Eight numbers of each part: force, -, torque, - on a grain; or in sums over contacts F_a r_b xx yy zz, F.u, F_a
   *  r_b yz xz xy, -. */
  static constexpr int power_place = 3, power_moments = 7;
  /** Sums over the contacts of one evaluation with one kind of partner. */
  struct Contacts {
    double sums[parts][8] = {};
    double normal_energy = 0.0, spring_energy = 0.0;
    double elastic_path = 0.0;  // (F0 + F1)/2 dd + (dU/dk) dk of contacts that touched before
    double new_elastic = 0.0;   // the half step's work of those that did not
    double kept_elastic = 0.0, kept_spring = 0.0, kept_energy = 0.0;  // of the past of those that did
    double friction = 0.0, stiffening = 0.0, travel = 0.0, revived = 0.0;
  };
  /** Of contacts between grains that come side by side, lane by lane, until the evaluation ends. */
  struct LaneContacts {
    Lanes sums[parts][power_moments]{};
    Lanes normal_energy{}, spring_energy{}, elastic_path{}, new_elastic{}, kept_elastic{}, kept_spring{}, kept_energy{},
        friction{}, stiffening{}, travel{}, revived{};
    void move_to(Contacts &sums);
  };
  /** Further sums over contacts with walls, c the contact point: F_a c_b xx yy zz, F.V, F_a c_b yz xz xy, -; F; and
   *  each by itself. */
  struct Touch {
    int grain, wall, triangle;
    Eigen::Vector3d velocity;
    std::array<Eigen::Vector3d, parts> force;
    bool operator<(const Touch &other) const;
  };
  struct WallContacts {
    double places[parts][8] = {}, force[parts][4] = {};
    std::vector<Touch> touches;
    bool moving = false;  // a wall
    void add(int part, const Contact &c, const Eigen::Vector3d &force_of_part);
    void clear();
  };
  /** One evaluation. */
  struct Evaluation {
    Contacts contacts[partners];
    WallContacts walls;
  };
  struct Ends {
    double k_tr = 0.0, k_rot = 0.0, other[4] = {}, weight = 0.0;
  };  // arrays: three terms of a sum, dt/2 times
  struct Starts {
    double rate[partners * parts][4] = {}, work[partners][parts] = {}, other[4] = {}, shear = 0.0, box = 0.0;
    double drift[4] = {}, stretch[4] = {};  // of W_box along three axes: in the step, -1/dt times; before it
    // in the frame of the last step, in that carried on, in the next
    double k_old = 0.0, k_carried = 0.0, k_new = 0.0, k_rot = 0.0;
    double weight = 0.0;
  };

  /** The terms of a contact law that are booked. */
  struct Law {
    double exponent = 1.5;
    double energy_factor = 0.4;  // U_n = energy_factor k_n overlap^2
    bool spring = false;         // a tangential one
    bool viscous = false;        // tangential damping, or friction without a spring
    bool rolling = false;
    Law() = default;
    explicit Law(const ContactLaw &law);
    bool has(Part part) const;
  };
  Law law_;                       // between grains
  int slot_[partners][parts];     // of a part in a grain's wrenches, or -1
  int slots_ = 0, kinds_ = 1;     // kinds: of partners that there are
  int own_ = 0;                   // grains
  int emptied_ = 0;               // of these, by the last step
  std::vector<double> wrenches_;  // eight numbers for each part on each of them, and on one more, which is all ghosts
  bool filled_[partners * parts] = {};  // slots that are not 0
  Evaluation now_, before_;
  LaneContacts lanes_;
  Ends ends_;
  Starts starts_;
  LedgerFrame frame_, next_, carried_;
  // the frame changed since the last step: carried on by its velocities, by new velocities
  bool moved_ = false, driven_ = false;
  bool stepped_ = false;  // the contacts were booked as the end of a step
  bool started_ = false;  // there was a step before
  Entries totals_{}, last_{}, between_{};
  Entries passed_{};  // by grains that left and came within the step
  Stores stored_{}, stored_before_{};
  Stores ended_{};  // at the end of the last step
  double start_energy_ = 0.0;

  double *wrenches_of(int i) { return &wrenches_[8 * static_cast<std::size_t>(i) * slots_]; }
  static double half_work(const Contacts &contacts, int part, double dt);
  static double wall_power(const WallContacts &sums, int part, const LedgerFrame &frame);
  struct Unit;
  struct LaneStarts;
  bool start_four(const Grains &grains, int i, double dt, LaneStarts &sums);
  struct LaneArms;
  /** Where a part is in the wrenches that grains have of each other: they are the first, in the order of the parts, and
   *  of spring and sliding a law has one. */
  static constexpr int lane_slot(Part part) { return part <= damping ? part : part <= sliding ? spring : sliding; }
  void add_normal(const ContactLanes &c, const LaneArms &arms, const Lanes *sizes);
  void add_tangential(Part part, int slot, const ContactLanes &c, const LaneArms &arms, const Lanes *force);
  void add_past(const ContactLanes &c, const Lanes &weight, const Lanes &elastic_force);
  void add_spring(const ContactLanes &c, const Lanes &weight);
  template <Partner partner>
  void add_contact(const Law &law, const Contact &c, double dt, bool springs_move);
  void add_with_wall(const Contact &c, int grain_id, double dt, bool springs_move);
  template <Partner partner>
  void add_part(int part, double size, const Unit &unit, const Contact &c, double *of_i, double *of_j);
  static void add_past(Contacts &sums, const Law &law, const Contact &c, double elastic_force);
  static void add_spring(Contacts &sums, const Contact &c);
  void book_contacts(Partner partner, double dt, Entries &step) const;
  void book_walls(double dt, Entries &step);
  void take_velocity_of_step(double dt);
  void store(double k_tr, double k_rot);
};

}

#endif

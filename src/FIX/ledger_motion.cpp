// SPDX-License-Identifier: GPL-2.0-or-later
#include "ledger_motion.h"
#include "box_jump.h"
#include "box_state.h"
#include "fix_press_strain.h"
#include "grain_shape.h"
#include "spheroid_rotation.h"
#include "atom.h"
#include "domain.h"
#include "update.h"
#include <Eigen/Geometry>
#include <algorithm>

namespace grainscope {

using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

LedgerFrame frame_of(LAMMPS_NS::LAMMPS *lmp) {
  const BoxState box(lmp);
  return {box.velocity_gradient, box.centre, box.edges.diagonal(), box.edge_velocities.diagonal()};
}

}

EnergyLedger::Grain LedgerMotion::shown(int i) const {
  static const double none[3] = {0.0, 0.0, 0.0};
  const bool held = movers_.hold(atom->mask[i]);
  return {i, atom->rmass[i], atom->x[i], atom->v[i], held ? none : atom->f[i], held ? none : atom->torque[i]};
}

EnergyLedger::Grains LedgerMotion::all_shown() const {
  const bool tops = atom->superquadric_flag;
  return {atom->nlocal,
          atom->mask,
          groupbit_,
          movers_.frozen,
          atom->rmass,
          atom->x[0],
          atom->v[0],
          atom->f[0],
          atom->torque[0],
          atom->omega[0],
          tops ? atom->angmom[0] : nullptr,
          tops ? atom->inertia[0] : nullptr,
          tops ? atom->quaternion[0] : nullptr,
          atom->radius,
          inertia_factor(domain->dimension)};
}

/** many(grains, i): takes grains side by side from i on, and tells where it stops; one(i) takes the others. */
template <class Many, class One>
void LedgerMotion::show_all(Many many, One one) const {
  if (atom->nlocal == 0) return;
  const EnergyLedger::Grains grains = all_shown();
  for (int i = 0; i < grains.n;) {
    i = many(grains, i);
    for (const int last = std::min(i + LANES, grains.n); i < last; i++)
      if (atom->mask[i] & groupbit_) one(i);
  }
}

Vector3d LedgerMotion::weight(int i) const {
  const int mask = atom->mask[i];
  if (movers_.hold(mask)) return Vector3d::Zero();
  return atom->rmass[i] * gravity_.acceleration(mask);
}

/** Of a sphere, whose angular momentum the host does not keep. */
double LedgerMotion::inertia_of_sphere(int i) const { return moment_of_inertia(*atom, i, domain->dimension); }

/** Where it is kept, or made for a sphere in `place`. */
inline const double *LedgerMotion::momentum(int i, double place[3]) const {
  if (atom->superquadric_flag) return atom->angmom[i];
  for (int k = 0; k < 3; k++) place[k] = inertia_of_sphere(i) * atom->omega[i][k];
  return place;
}

/** Angular momentum now, and angular velocity after the kick of the next half step. For spheroids from the angular
 *  momentum, which the integrators keep; `velocity setAngular` of LIGGGHTS does not change omega with it. */
void LedgerMotion::coming_spin(const EnergyLedger::Grain &grain, double momentum[3], double omega_after[3]) const {
  const int i = grain.index;
  const double half = 0.5 * update->dt, *torque = grain.torque;
  double kicked[3];
  if (!atom->superquadric_flag) {
    const double inertia = inertia_of_sphere(i);
    for (int k = 0; k < 3; k++) {
      momentum[k] = inertia * atom->omega[i][k];
      omega_after[k] = atom->omega[i][k] + half / inertia * torque[k];
    }
    return;
  }
  for (int k = 0; k < 3; k++) {
    momentum[k] = atom->angmom[i][k];
    kicked[k] = momentum[k] + half * torque[k];
  }
  const double *inertia = atom->inertia[i];
  if (is_symmetric_top(inertia)) return angular_velocity(inertia, kicked, atom->quaternion[i], omega_after);
  const Matrix3d r = orientation(*atom, i).toRotationMatrix();
  Map<Vector3d>(omega_after + 0) =
      r * (r.transpose() * Map<const Vector3d>(kicked)).cwiseQuotient(Map<const Vector3d>(inertia));
}

void LedgerMotion::start_step(EnergyLedger &ledger) const {
  const bool pulled = !gravity_.none();
  gravity_.update();
  const BoxJump *const jump = LAMMPS_NS::FixPressStrain::last_jump_of(lmp);
  Vector3d given;
  ledger.begin_start_of_step(frame_of(lmp));
  const double dt = update->dt;
  show_all([&](const EnergyLedger::Grains &grains, int i) { return ledger.start_of_step(grains, i, dt); },
           [&](int i) {
             const EnergyLedger::Grain grain = shown(i);
             double momentum[3], omega_after[3];
             coming_spin(grain, momentum, omega_after);
             ledger.start_of_step(grain, omega_after, momentum, dt);
           });
  for (int i = 0; (pulled || jump) && i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit_)) continue;
    const EnergyLedger::Grain grain = shown(i);
    if (pulled) ledger.start_with_weight(grain, weight(i), dt);
    if (jump && jump->gives(Map<const Vector3d>(grain.x), given)) ledger.start_with_jump(grain, given);
  }
  ledger.book_start(dt);
}

void LedgerMotion::end_step(EnergyLedger &ledger) const {
  const bool pulled = !gravity_.none();
  gravity_.update();
  ledger.begin_end_of_step();
  const double dt = update->dt;
  show_all([&](const EnergyLedger::Grains &grains, int i) { return ledger.end_of_step(grains, i, dt); },
           [&](int i) {
             double place[3];
             ledger.end_of_step(shown(i), atom->omega[i], momentum(i, place), dt);
           });
  for (int i = 0; pulled && i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit_) ledger.end_with_weight(shown(i), weight(i));
  ledger.book_step(dt);
}

/** In the middle of a step: with the velocities of the half step, before or after grains were dealt out. */
std::unique_ptr<LedgerGrains> LedgerMotion::grains_in_step(const EnergyLedger &ledger) const {
  std::unique_ptr<LedgerGrains> grains(new LedgerGrains);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit_)) continue;
    double place[3];
    grains->add(atom->tag[i], ledger.kinetic_in_step(shown(i), atom->omega[i], momentum(i, place)));
  }
  return grains;
}

std::unique_ptr<LedgerGrains> LedgerMotion::grains_between_steps(const EnergyLedger &ledger) const {
  std::unique_ptr<LedgerGrains> grains(new LedgerGrains);
  const BoxJump *const jump = LAMMPS_NS::FixPressStrain::last_jump_of(lmp);
  Vector3d given, before;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit_)) continue;
    EnergyLedger::Grain grain = shown(i);
    if (jump && jump->gives(Map<const Vector3d>(grain.x), given)) {
      before = Map<const Vector3d>(grain.v) - given;  // the frame is that of the last step
      grain.v = before.data();
    }
    double momentum[3], omega_after[3];
    coming_spin(grain, momentum, omega_after);
    grains->add(atom->tag[i], ledger.kinetic_between_steps(grain, omega_after, momentum, update->dt));
  }
  return grains;
}

}
